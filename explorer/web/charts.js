// @ts-check
// The strip below the scene, and the twist curve that can be dragged.
(() => {
  const {text, clamp, write, outdate, closest, paced, drag, scale: grown} = Common, {part} = RX;
  // Where a chart is so narrow that its heading would be cut.
  const SHORT = {power: 'Power', alpha: 'α'};
  const whole = new Set();  // Charts that show all of their y, by name.
  function drawChart(element, {name, kind, stale, chart: drawn, speeds}) {
    const by = grown(), width = Math.max((element.clientWidth - 32) / by, 60);
    const tight = element.toggleAttribute('data-tight', width < 260);
    const y = {...drawn.y, ...whole.has(name) && drawn.y.whole};
    const chart = {...drawn, y, kind, speeds}, {title} = drawn;
    const height = Math.max((element.clientHeight - 18) / by - 20, 40);
    const short = {title: SHORT[name] || title, y: {...y, label: y.label.replace(/^both /, '')}};
    outdate(element, stale);
    element.dataset.name = name;
    if (element.parentElement.clientHeight < RX.folded) return Charts.spark(element, {...chart, ...short});
    const scale = y.whole && `<button data-page="scale" aria-pressed="${whole.has(name)}"
      title="The whole axis, or the part around the least. A double click does the same">
      whole${tight ? '' : ' range'}</button>`;
    Charts.fill(element, tight ? {...chart, ...short} : chart, {width, height, scale});
    const {X, Y} = element.drawn.place, power = speeds && chart.series.at(-1).y[0];
    if (power !== null && power !== undefined) element.querySelector('svg').insertAdjacentHTML('beforeend',
      `<circle cx="${X(speeds.mu)}" cy="${Y(power)}" r="11" data-speed>
        <title>Drag: speed. Double click: the fastest trim</title></circle>`);
    sayLimit();
  }
  // Speed is dragged by the dot of power over µ, up to the first wall ahead, which is named.
  let limit = '', flown = null;
  const sayLimit = () => { if (limit) flown.querySelector('[data-value]').textContent = limit; };
  const speeding = paced(speed => RX.send('slide', ['advance_ratio', speed]));
  drag(document, '[data-speed]', (dot, event) => {
    const element = dot.closest('.rxf-chart'), {mu, fastest} = element.drawn.chart.speeds, letGo = RX.hold();
    const most = mu > fastest + .005 ? element.drawn.chart.x.range[1] : fastest;
    event.preventDefault();
    flown = element;
    return {
      move({clientX}) {
        const {place, chart} = element.drawn, {left, width} = element.querySelector('svg').getBoundingClientRect();
        const speed = clamp(place.atX((clientX - left) * place.width / width), 0, most);
        const wall = chart.rules?.find(({at}) => Math.abs(at - speed) < .006)?.label ?? 'slider';
        limit = speed < most ? '' : `limit: ${wall}`;
        sayLimit();
        speeding.send(speed);
      },
      end() { speeding.flush(); limit = ''; letGo(); },
    };
  });
  function rescale(element) {
    const {name} = element?.dataset ?? {};
    if (!element?.drawn?.chart.y.whole) return;
    if (!whole.delete(name)) whole.add(name);
    RX.again('strip');
  }
  document.addEventListener('click', event => rescale(closest(event, '[data-page=scale]')?.closest('.rxf-chart')));
  document.addEventListener('dblclick', event => {
    const chart = closest(event, '[data-speed]')?.closest('.rxf-chart').drawn.chart;
    if (chart) RX.send('slide', ['advance_ratio', chart.speeds.fastest]);
    else rescale(closest(event, 'svg')?.closest('.rxf-chart'));
  });
  RX.paint('strip', charts => {
    const strip = part('strip');
    while (strip.children.length > charts.length) strip.lastChild.remove();
    while (strip.children.length < charts.length)
      strip.insertAdjacentHTML('beforeend', '<div class="rxf-chart"></div>');
    if (strip.offsetParent === null && !strip.offsetHeight) return;
    charts.forEach((chart, k) => { if (chart) drawChart(strip.children[k], chart); });
  });

  // What a step up of a slider changes, with its sign, and an arrow from the thumb the way that saves power.
  function arrow({way, size}, place) {
    // The track lies between the label and the number.
    const slider = place.parentElement?.previousElementSibling?.querySelector('.mantine-Slider-root');
    const track = slider?.getBoundingClientRect(), handle = slider?.querySelector('.mantine-Slider-thumb');
    const [now, low, high] = ['Now', 'Min', 'Max'].map(name => Number(handle?.[`ariaValue${name}`]));
    const at = handle ? (now - low) / (high - low) : .5, up = way === 'up';
    if (!way || (up ? at >= .999 : at <= .001)) return '';  // No arrow beyond the end of the slider.
    const own = place.getBoundingClientRect();
    const [from, width] = track?.width ? [track.left - own.left, track.width] : [76, 166], thumb = from + at * width;
    const length = Math.min(8 + 36 * size, Math.max(6, (up ? own.width - thumb : thumb - from) - 8));
    return `<i data-way="${way}" style="left:${up ? thumb : thumb - length}px;width:${length}px"></i>`;
  }
  // With every answer, as the strip has it, a thumb may stand elsewhere.
  RX.paint(['worth', 'strip'], worths => {
    const moved = [...document.querySelectorAll('[data-worth]')].filter(place => {
      const row = place.parentElement?.previousElementSibling, thumb = row?.querySelector('.mantine-Slider-thumb');
      const worth = JSON.stringify(worths[place.dataset.worth]);
      const stands = [worth, thumb?.ariaValueNow, thumb?.ariaValueMax, innerWidth].join();
      if (place.stands === stands && place.childElementCount) return false;
      return place.stands = stands;
    });
    // To ask where things are between two writes costs a layout: all are asked first.
    const arrows = moved.map(place => worths[place.dataset.worth] && arrow(worths[place.dataset.worth], place));
    moved.forEach((place, k) => {
      const worth = worths[place.dataset.worth], {way, value, unit} = worth ?? {};
      const number = way ? `<b ${way === 'up' ? 'class="rxf-good"' : ''}>${text(value)}</b>${text(unit)}` : text(value);
      write(place, worth ? `${arrows[k]}<span>${number}</span>` : '');
      if (!worth) return;
      outdate(place, worth.stale);
      place.title = worth.sentence;
    });
  });

  const MEANT = {
    jig: 'Built-in twist, set by the sliders',
    flown: 'Twist in flight: built-in, active and elastic; mean over azimuth, shaded from least to greatest',
  };
  // One row, in the corner where it covers none of the curves, or least of them; it stays there while it can.
  const WORDS = {jig: [['built-in, set by sliders', 158]], flown: [['built-in', 70], ['in flight, band over ψ', 150]]};
  let corner = 0;
  function drawKey({series}, {X, Y, left, right, top, base}) {
    const named = series.filter(({label}) => label).reverse(), words = WORDS[named.at(-1).label];
    const width = words.reduce((sum, [, size]) => sum + size, 0);
    const points = series.flatMap(({x, y, low, high}) =>
      [y, low, high].filter(Boolean).flatMap(values => x.map((at, k) => [X(at), Y(values[k])])));
    const corners = [top, base - 16].flatMap(above => [right - width, left + 4].map(from => [from, above]));
    const met = corners.map(([from, above]) => points.filter(([x, y]) =>
      x > from - 4 && x < from + width && y > above - 3 && y < above + 16).length);
    const least = Math.min(...met);
    if (met[corner] > least + 6 || (met[corner] && !least)) corner = met.indexOf(least);
    let [from] = corners[corner];
    const [, above] = corners[corner];
    return named.map(({label, colour}, k) => {
      const at = from;
      from += words[k][1];
      return `<g data-key="${label}"><title>${MEANT[label]}</title>
        <path d="M${at + 3} ${above + 6}h14" stroke="${colour}" stroke-width="2.2"/>
        <text x="${at + 21}" y="${above + 9.5}"
          style="paint-order:stroke;stroke:var(--rx-paper);stroke-width:3px">${words[k][0]}</text></g>`;
    }).join('');
  }

  // The twist curve: its handles are dragged, or moved by arrow keys.
  RX.paint('twist', twist => {
    for (const place of document.querySelectorAll('[data-curve]')) {
      const by = grown(), [width, height] = [place.offsetWidth / by, place.offsetHeight / by];
      const stamp = JSON.stringify([twist, width, height]);
      if (!width || (place.stamp === stamp && place.childElementCount)) continue;
      const {chart} = twist, focus = document.activeElement?.dataset?.knot;
      const frame = Charts.frame(chart, width, height, {left: 36});
      const handles = twist.knots.map(({name, r, theta, title}) => `
        <g data-knot="${name}" tabindex="0" role="slider" aria-label="${text(title)}" aria-valuenow="${theta}"
          aria-valuetext="${theta}° at ${r} R"><title>${text(title)}</title>${['data-reach r="5"', 'r="5"'].map(of =>
          `<circle ${of} cx="${frame.X(r).toFixed(1)}" cy="${frame.Y(theta).toFixed(1)}"/>`).join('')}</g>`);
      place.innerHTML = `<svg viewBox="0 0 ${width} ${height}" role="group" aria-label="Twist curve">
        ${Charts.axes(chart, frame)}${Charts.inside(chart, frame)}${drawKey(chart, frame)}${handles.join('')}</svg>`;
      Object.assign(place, {stamp, frame});
      if (focus) place.querySelector(`[data-knot="${focus}"]`)?.focus();
    }
  });
  const knots = paced(change => RX.send('knot', change));
  drag(document, '[data-knot]', (knot, event) => {
    const place = knot.closest('[data-curve]'), name = knot.dataset.knot;
    event.preventDefault();
    knot.focus();
    RX.send('knot', [name, 'start']);
    return {
      move({clientX, clientY}) {
        const {left, top} = place.getBoundingClientRect(), {atX, atY} = place.frame, by = grown();
        knots.send([name, [atX((clientX - left) / by), atY((clientY - top) / by)]]);
      },
      end() { setTimeout(() => RX.send('knot', [name, 'end']), 70); },
      escape() { knots.drop(); },
    };
  });
  const STEPS = {ArrowUp: [0, .1], ArrowDown: [0, -.1], ArrowLeft: [-.01, 0], ArrowRight: [.01, 0]};
  let stepped = null;
  document.addEventListener('keydown', event => {
    const name = closest(event, '[data-knot]')?.dataset.knot, step = name && STEPS[event.key];
    if (!step) return;
    // Presses that come faster than answers add up.
    const at = performance.now(), many = event.shiftKey ? 10 : 1;
    const {r, theta} = stepped?.name === name && at - stepped.at < 700 ? stepped
      : RX.state.twist.knots.find(knot => knot.name === name);
    event.preventDefault();
    event.stopPropagation();
    stepped = {name, r: r + many * step[0], theta: theta + many * step[1], at};
    knots.send([name, [stepped.r, stepped.theta]]);
  }, true);
})();
