// @ts-check
// The card of the actuator as set: whether it can be built, what it moves, weighs and earns, and the scale of power.
(() => {
  const {text, write, staleMark, closest, clamp, paced, drag} = Common, {part} = RX, page = document.documentElement;
  const card = part('verdict');
  const GAP = 12;  // Least distance of two labels [px].

  RX.paint(['assessed', 'line'], (one, line) => {
    const shown = Boolean(one) && !line?.problem;
    card.hidden = !shown;
    page.toggleAttribute('data-assessed', shown);
    if (!one || !shown) return;
    const before = document.activeElement;
    const focused = before && card.contains(before) ? namesOf(before) : '';
    write(card, `<p class="rxv-row rxf-num" data-explorer="assessed">${row(one)}</p>${limits(one)}
      <div class="rxv-head"><span class="rxf-dim" data-explorer="scale-unit">${heading(one.scale)}</span>
        ${compared(one)}</div>${scale(one.scale)}
      <p class="rxf-pays rxf-num">${pays(one)}</p>`);
    const button = card.querySelector('[data-unfold]');
    if (button) button.ariaExpanded = String(Boolean(page.dataset.unfolded?.split(' ').includes('limits')));
    arrange();
    if (!focused || card.contains(document.activeElement)) return;
    card.querySelector(focused)?.focus({preventScroll: true});
  });
  // A selector of the same control in the card that is drawn next.
  const NAMES = ['do', 'value', 'unfold', 'mission', 'explorer'];
  const namesOf = (/** @type {any} */ {dataset}) => NAMES.filter(name => name in dataset)
    .map(name => `[data-${name}="${dataset[name]}"]`).join('');

  function row({buildable, tip, end, reach, mass, earns, sure, mission, problem, over, required}) {
    const opens = over.length + required.length;
    const built = opens ? `<button data-unfold="limits" aria-expanded="false" title="Show the limits">${text(buildable)}
      </button>` : `<span>${text(buildable)}</span>`;
    const range = reach && `Range of tip twist in flight, nose up positive: ${reach}`;
    const title = `By schedule, ${mission}. ± is one standard deviation${sure && `; the sign is ${sure}`}.`;
    return [
      buildable ? built : problem ? '' : '<span class="rxf-dim">checking limits …</span>',
      `<span title="${text(range)}">moves <b data-explorer="moves">${text(tip)}</b>${end && ` of ${text(end)}`}</span>`,
      `<span title="On all blades and in the cabin"><b data-explorer="costs">${text(mass)}</b></span>`,
      earns ? `<span title="${text(title)}"><b data-explorer="gives">${text(earns)}</b> over the
        <button data-mission title="Set its hours">mission</button>${sure
        && ` <span class="rxf-dim" data-cap>(${text(sure)})</span>`}</span>`
        : problem ? `<span>${text(problem)}</span>` : '<span class="rxf-dim">mission …</span>',
    ].filter(Boolean).join(' ');
  }

  // Behind the first words of the row: each limit with its value, and the press that keeps them.
  function limits({over, required, feasible}) {
    const listed = (name, list) => list.length ? `<span>${name}: ${list.map(words => `<span>${text(words)}</span>`)
      .join(' ')}</span>` : '';
    return over.length + required.length ? `<p class="rxf-over rxf-num" data-explorer="over">
      ${listed('Over its limits', over)}
      ${feasible && `<button data-do="feasible" title="Set an actuator of this kind within its limits">Make it
        feasible: ${text(feasible)}</button>`}
      ${listed('The best twist needs', required)}</p>` : '';
  }

  const compared = ({baselines, against}) => `<div role="group" aria-label="Compared with"><span class="rxf-dim">vs.
    </span>${baselines.map(([name, title]) => `<button data-do="against" data-value="${name}"
      aria-pressed="${name === against}">${text(title)}</button>`).join('')}</div>`;

  function heading(powers) {
    if (!powers) return 'Power in this flight …';
    const waits = powers.marks.filter(({at}) => at === null).map(({name}) => name);
    const late = waits.length ? `; computing ${text(waits.join(', '))} …` : '';
    return `Power in this flight [${text(powers.unit)}]${late}`;
  }

  // Marks at their powers, and below them the labels, which `arrange` puts beside each other.
  function scale(powers) {
    if (!powers) return '<div class="rxv-scale"></div>';
    const {ends: [low, high], sentence} = powers;
    const marks = powers.marks.filter(({at}) => at !== null);
    const share = at => 100 * clamp((at - low) / (high - low), 0, 1);
    const drawn = marks.map(({at, band, flown, stale}) => {
      const from = share(at - band), to = share(at + band);
      return `${band ? `<s style="left:${from}%;width:${to - from}%"></s>` : ''}<i style="left:${share(at)}%"
        ${flown ? 'data-flown' : ''}${staleMark(stale)}></i>`;
    }).join('');
    const labels = marks.map(({name, value, at, band, flown, stale}) => `<span data-at="${share(at)}"
      title="${text(band ? `${name}: the change has a band of ± ${Number(band.toPrecision(2))} ${powers.unit}` : name)}"
      ${flown ? 'data-flown' : ''}${staleMark(stale)}>${text(name)}<b>${text(value)}</b></span>`).join('');
    return `<div class="rxv-scale rxf-num" role="img" aria-label="${text(sentence)}" data-explorer="scale"><svg></svg>
      ${drawn}${labels}</div>`;
  }

  // Labels below their marks; those that would touch stand beside each other, and a line leads to each.
  function arrange() {
    const drawing = card.querySelector('.rxv-scale');
    const labels = [...drawing?.querySelectorAll('span') ?? []];
    const room = drawing?.clientWidth ?? 0;
    if (!room || !labels.length) return;
    const marks = labels.map(label => label.dataset.at / 100 * room);
    const widths = labels.map(label => label.offsetWidth);
    const lefts = spread(marks, widths, room);
    labels.forEach((label, k) => label.style.left = `${lefts[k]}px`);
    drawing.querySelector('svg').innerHTML = marks.map((at, k) => {
      const below = clamp(at, lefts[k] + 4, lefts[k] + widths[k] - 4);
      return `<path d="M${at} 6L${below} 21"/>`;
    }).join('');
  }
  new ResizeObserver(arrange).observe(card);

  // Left ends of labels in a row, each as near to its mark as the others let it: those that touch move as one block.
  function spread(marks, widths, room) {
    const spare = room - widths.reduce((sum, width) => sum + width, 0);
    const gap = clamp(spare / Math.max(widths.length - 1, 1), 0, GAP);
    const blocks = [];
    marks.forEach((at, k) => {
      let block = {first: k, count: 1, width: widths[k], wanted: at - widths[k] / 2};
      const left = ({wanted, count, width}) => clamp(wanted / count, 0, Math.max(room - width, 0));
      for (let last = blocks.at(-1); last && left(last) + last.width + gap > left(block); last = blocks.at(-1)) {
        blocks.pop();
        const moved = block.wanted - block.count * (last.width + gap);
        block = {first: last.first, count: last.count + block.count, width: last.width + gap + block.width,
          wanted: last.wanted + moved};
      }
      blocks.push({...block, left: left(block)});
    });
    return blocks.flatMap(({first, count, left}) => {
      let at = left;
      return widths.slice(first, first + count).map(width => {
        at += width + gap;
        return at - width - gap;
      });
    });
  }

  const pays = ({vibration, pays: words}) => [
    vibration && `<span class="rxf-dim">${vibrates(vibration)}</span>`,
    words.map((piece, k) => k % 2 ? `<b><button data-pays data-explorer="pays-${k}"
      title="Press or drag to try such an actuator">${text(piece)}</button>${words[k + 1][0]}</b>`
      : text(k ? piece.slice(1) : piece)).join('')].filter(Boolean).join(' ');
  const vibrates = words => `${text(words[0].toUpperCase() + words.slice(1))}.`;

  // A number that would make it pay puts the supposed actuator there; dragged, it goes on from there.
  const suppose = paced(place => RX.send('suppose', place), 80);
  drag(card, '[data-pays]', (button, {clientX}) => {
    const {range, kilograms} = RX.shown('assessed'), size = parseFloat(button.textContent);
    const mass = button.textContent.includes('kg'), at = share => mass
      ? [range, Math.max(size * share, .1)] : [Math.min(size * share, 20), kilograms];
    RX.send('suppose', 'on');
    suppose.send(at(1));
    return {move: event => suppose.send(at(Math.exp((event.clientX - clientX) / 150)))};
  });
  card.addEventListener('keydown', event => {
    if (closest(event, '[data-pays]') && ['Enter', ' '].includes(event.key)) RX.send('suppose', 'on');
  });
})();
