// @ts-check
// The cards on the stage: power, vibration, quantity on the disk.
(() => {
  const {text, write, staleMark, outdate, closest, paced, drag} = Common, {part} = RX, page = document.documentElement;

  RX.paint('power', power => {
    const card = part('power'), {parts} = power;
    const widths = parts.map(({share}) => Math.max(share, 0));
    // What a part gives back lies over the end of what the others need: both ends of the rest bound the total.
    const given = parts.filter(({share}) => share < 0), back = given.reduce((sum, {share}) => sum - share, 0);
    const needed = widths.reduce((sum, width) => sum + width, 0), below = Math.max(back - needed, 0);
    const total = Math.max(needed + below, 1e-6);
    const bars = [`<div style="flex:${below / total}"></div>`, ...widths.map((width, k) =>
      `<div style="flex:${width / total};background:var(--rx-${parts[k].part})"></div>`)].slice(below ? 0 : 1).join('');
    const over = back && `<s style="width:${100 * back / total}%">${given.map(one =>
      `<i style="flex:${-one.share / back};background:var(--rx-${one.part})"></i>`).join('')}</s>`;
    const ideal = power.ideal === null ? ''
      : `<u style="left:${100 * (below + power.ideal) / total}%" title="${text(power.ideal_title)}"></u>`;
    const key = parts.map(one => `<div style="--c:var(--rx-${one.part})" title="${text(one.title)}">
      <dt>${text(one.name)}</dt><dd class="rxf-num" data-between>${text(one.value)}</dd></div>`).join('');
    card.innerHTML = `<div data-answers>
      <div class="rxf-parts" role="button" tabindex="0" data-do="drawer" data-value="details"
        title="Power and trim in detail">
        <div>${bars}${over || ''}${ideal}</div><dl>${key}</dl></div></div>
      <div class="rxf-why rxf-num" data-answers data-explorer="why" title="${text(power.why)}"
        ${power.why ? '' : 'hidden'}></div>`;
    // What has no room is left out clause by clause, never cut within one: the tooltip has it all.
    const why = card.querySelector('.rxf-why');
    const said = power.why.replace(/ ± | (?=k?W|hp)/g, one => one.replaceAll(' ', '\u00a0'));
    const clauses = said.split('; ');
    const room = parseFloat(getComputedStyle(why).minHeight) + 1;
    why.textContent = said;
    while (clauses.length > 1 && why.offsetHeight > room) {
      clauses.pop();
      why.textContent = `${clauses.join('; ')}.`;
    }
  });
  // What the actuator moves, costs and gives beside the line; where there is little room, in one sentence.
  RX.paint(['assessed', 'line'], (one, line) => {
    const card = part('verdict'), shown = Boolean(one) && !line?.problem;
    card.hidden = !shown;
    page.toggleAttribute('data-assessed', shown);
    if (!one || !shown) return;
    const {against, baselines, vibration} = one;
    const column = (name, words, more, title = '') => `<div title="${text(title)}"><h2>${name}</h2>${words}
      <p class="rxf-dim rxf-num">${more}</p></div>`;
    const blades = baselines.map(([name, title]) => `<button data-do="against" data-value="${name}"
      aria-pressed="${name === against}">${text(title)}</button>`).join('');
    const masses = one.masses.map(([name, mass]) => `<i>${text(name)} ${text(mass)}</i>`).join(' · ');
    const pays = one.pays.map((words, k) => k % 2 ? `<b><button data-pays class="rxf-num" data-explorer="pays-${k}"
      title="Press or drag to try such an actuator">${text(words)}</button>${one.pays[k + 1][0]}</b>`
      : text(k ? words.slice(1) : words)).join('');
    // On a low telephone the line alone names the limits; their values are in the rail.
    const listed = (name, list) => list.length ? `<b>${name}:</b>
      ${list.map(words => `<span>${text(words)}</span>`).join(' ')}` : '';
    const limits = one.over.length + one.required.length ? `<p class="rxf-over rxf-num" data-explorer="over">
      <span data-over>${listed('Over its limits', one.over)}</span>
      ${one.feasible && `<button data-do="feasible" title="Set an actuator of this kind within its limits">Make it
        feasible: ${text(one.feasible)}</button>`}
      <span class="rxf-dim">${listed('The best twist needs', one.required)}</span></p>` : '';
    write(card, `<header data-explorer="assessed"><div role="group" aria-label="Compared with">
        <span class="rxf-dim">vs.</span>${blades}</div></header>
      ${limits}<div class="rxf-columns">
        ${column('moves', `<b class="rxf-num" data-explorer="moves">${text(one.tip)}</b> at the tip, in flight`,
          `${one.reach && `<span>reach ${text(one.reach)}</span>`}<span>${text(vibration)}</span>`,
          `Twist that the actuator adds at the tip in flight, positive nose up; airloads reduce it by 1 to 10 %.
          Vibration: mean and range over inflow models, blades bend.`)}
        ${column('costs', `<b class="rxf-num" data-explorer="costs">${text(one.mass)}</b> on board`, masses,
          'On all blades and in the cabin')}
        ${column(`by schedule, over the <button data-mission title="Set its hours">mission</button>`,
          `<b class="rxf-num">${text(one.flight || '…')}</b>`,
          text(one.flights), 'The same for every setting here. ± is one standard deviation.')}
      </div>
      <p class="rxf-pays"><span data-explorer="said">${text(one.sentence)} </span>${text(one.problem)} ${pays}</p>`);
  });
  // A number that would make it pay puts the supposed actuator there; dragged, it goes on from there.
  const suppose = paced(place => RX.send('suppose', place), 80);
  drag(part('verdict'), '[data-pays]', (button, {clientX}) => {
    const {range, kilograms} = RX.shown('assessed'), size = parseFloat(button.textContent);
    const mass = button.textContent.includes('kg'), at = share => mass
      ? [range, Math.max(size * share, .1)] : [Math.min(size * share, 20), kilograms];
    RX.send('suppose', 'on');
    suppose.send(at(1));
    return {move: event => suppose.send(at(Math.exp((event.clientX - clientX) / 150)))};
  });
  part('verdict').addEventListener('keydown', event => {
    if (closest(event, '[data-pays]') && ['Enter', ' '].includes(event.key)) RX.send('suppose', 'on');
  });

  // Vibration of blades that bend, a row of its own below the power.
  RX.paint('vibration', vibration => {
    const row = part('vibration');
    row.hidden = !vibration;
    document.documentElement.toggleAttribute('data-vibration', Boolean(vibration));
    if (!vibration) return;
    const {at, sentence, index, unit, band, change, kind, title} = vibration;
    row.title = title;
    row.ariaLabel = `Vibration: ${sentence || `${index} ${unit}, ${band}${change ? `, ${change}` : ''}. ${title}`}`;
    const numbers = `<span class="rxf-num"><b data-explorer="index">${text(index)}</b> ${text(unit)}</span>
      <span class="rxf-dim rxf-num" data-explorer="index-band">${text(band)}</span>
      <span class="rxf-num ${kind && `rxf-${kind}`}" data-explorer="index-change"
        ${change ? '' : 'hidden'}>${text(change)}</span>`;
    write(row, `<b>Vibration ${text(at)}</b>${sentence ? `<span class="rxf-dim">${text(sentence)}</span>` : numbers}`);
  });

  const line = (colour, dashes = '', width = 2.4) =>
    `<path d="M0 5.5H20" stroke="${colour}" stroke-width="${width}" stroke-dasharray="${dashes}"/>`;
  const CURVE = 'd="M0 8.5C6 1 13 1 20 6.5" stroke="var(--rx-accent)" stroke-width="1.8" fill="none"';
  const STRIPES = '<path d="M-3 11 8 0M3 11 14 0M9 11 20 0M15 11 26 0" stroke="var(--rx-stall)" stroke-width="2.2"/>';
  const FRAMED = 'width="18.6" height="9.6" fill="var(--rx-reverse)" stroke="#fff" stroke-width="1.4"';
  // On the disk in the scene; on its plan, which draws outlines.
  const REGIONS = [
    ['stall', 'Separated', `<rect width="20" height="11" fill="#8fcf7c"/>${STRIPES}`],
    ['past_static', 'Past static', line('var(--rx-stall)', '1.5 3.5', 2)],
    ['reverse_flow', 'Reverse flow', `<rect x=".7" y=".7" ${FRAMED}/>`],
    ['wake', 'Tip vortices', `<path ${CURVE}/>`],
    ['drag_divergence', 'Drag divergence', line('var(--rx-ink)', '4.5 2.5', 2)],
  ];
  const PLANNED = [
    ['stall', 'Separated', line('var(--rx-stall)')],
    ['past_static', 'Past static', line('var(--rx-stall)', '1.5 3.5', 2)],
    ['reverse_flow', 'Reverse flow', line('var(--rx-dim)')],
    ['drag_divergence', 'Drag divergence', line('var(--rx-ink)', '3 4')],
  ];
  // The two regions of stall: which is which, in one place each.
  const MEANT = {
    stall: 'The flow is separated over 30 % of the chord or more',
    past_static: 'The angle of attack is past the static stall angle, but the flow is still attached: separation lags',
  };
  // What a region costs, where its edge is, and the press that switches it off.
  RX.price = name => {
    const {lines, stale, press} = RX.state.prices?.[name] ?? {lines: [], stale: false, press: ''};
    const said = lines.map(words => `<span class="rxf-num">${text(words)}</span>`).join('');
    return `<span class="rxf-price"${staleMark(stale)}>${said}</span>${press
      && `<button class="rxf-push" data-do="unstall">${text(press)}</button>`}`;
  };
  const low = name => text(name).replace(/λi|_n|cn$/g, at => ({'λi': 'λᵢ', _n: 'ₙ', cn: 'cₙ'})[at] ?? at);
  RX.paint(['field', 'plan', 'prices'], (field, plan, prices) => {
    const card = document.querySelector('.rxf-field');
    card.hidden = !field;
    if (!field) return;
    const menu = card.querySelector('select'), scale = part('scale');
    const {regions, difference, wipe} = field;
    write(menu, field.fields.map(name => `<option value="${text(name)}">${low(name)}</option>`).join(''));
    if (menu.value !== field.field) menu.value = field.field;
    part('unit').textContent = field.unit.replace(/^, /, '');  // What follows a unit stands alone where there is none.
    outdate(scale, field.stale);
    const other = field.fitted ? 'the usual colour range (Shift+C)' : 'colours fitted to the data (C)';
    scale.title = `Double click: ${other}`;
    write(scale, Charts.bar(field.colours, field.ticks, field.beyond));
    const shares = plan ? Object.fromEntries(plan.regions.map(({name, words}) => [name, words.split(' · ')[0]]))
      : field.shares;
    const key = (plan ? PLANNED : REGIONS).map(([name, title, swatch]) => {
      const share = text(shares[name] ?? (plan && regions[name] ? 'none' : ''));
      // Beside a plan labels have the shares; of what it has none of there is no label.
      const words = plan && name in shares ? `<span class="rxf-num">${share}</span>` : share;
      return `<button data-do="region" data-value="${name}" aria-pressed="${regions[name]}"
        ${name in MEANT ? `title="${MEANT[name]}"` : ''}>
        <svg viewBox="0 0 20 11" aria-hidden="true">${swatch}</svg>${title} ${words}</button>`;
    });
    if (difference !== null) key.push(`
      <button data-do="difference" data-value="${difference ? 'off' : 'on'}" aria-pressed="${difference}">Show B − A
      </button>
      <button data-do="region" data-value="wipe" aria-pressed="${wipe}">Wipe A | B</button>`);
    for (const [name, title] of plan ? PLANNED : []) if (prices?.[name]) key.push(`<div class="rxf-priced"
      data-priced="${name}"><b>${title}</b>${RX.price(name)}</div>`);
    write(part('legend'), key.join(''));
  });

  part('scale').addEventListener('dblclick', () => RX.send('colours', RX.state.field.fitted ? 'Default' : 'Rescale'));

  RX.paint('turn', turn => {
    const row = document.querySelector('.rxf-turn'), slider = row.querySelector('input');
    const button = row.querySelector('[data-do=play]');
    if (document.activeElement !== slider || turn.playing) slider.value = String(turn.psi);
    row.querySelector('output').textContent = `ψ ${Math.round(turn.psi)}°`;
    write(button, RX.icon(turn.playing ? 'pause' : 'play'));
    button.ariaLabel = turn.playing ? 'Stop the rotor' : 'Turn the rotor';
  });
})();
