// @ts-check
// The cards on the stage: power, vibration, quantity on the disk.
(() => {
  const {text, write, staleMark, outdate} = Common, {part} = RX;

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
