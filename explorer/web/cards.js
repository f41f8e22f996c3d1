// The cards on the stage: power, quantity on the disk.
(() => {
  const {text, part} = RX;

  RX.paint('power', now => {
    const place = part('power');
    place.toggleAttribute('data-faded', Boolean(now.problem));
    const total = Math.max(now.parts.reduce((sum, one) => sum + Math.max(one.share, 0), 0), 1e-6);
    const bar = now.parts.map(one => `<div style="flex:${Math.max(one.share, 0) / total};background:var(--rx-${one.part})"></div>`).join('')
      + (now.ideal === null ? '' : `<u style="left:${100 * now.ideal / total}%" title="${text(now.ideal_title)}"></u>`);
    const key = now.parts.map(one => `<div style="--c:var(--rx-${one.part})" title="${text(one.title)}"><dt>${text(one.name)}</dt><dd class="rxf-num" data-between>${text(one.value)}</dd></div>`).join('');
    const since = now.since ? `<span class="${now.since.kind ? `rxf-${now.since.kind}` : ''}">${text(now.since.value)}</span> <small>${text(now.since.words)}</small>` : `<span>${text(now.rest)}</span>`;
    place.innerHTML = `<div data-explorer="power"><div class="rxf-total rxf-num" title="${text(now.doubt)}"><span data-explorer="total-power">${text(now.total)} <small>${text(now.unit)}</small></span> <small data-explorer="within">${text(now.within)}</small></div>
      ${now.since ? '' : '<div class="rxf-sub">total power</div>'}<div class="rxf-sub rxf-num" ${now.since ? '' : 'hidden'}><span data-explorer="change" class="${now.kind ? `rxf-${now.kind}` : ''}">${text(now.change)}</span> vs. <span data-explorer="against">${text(now.against)}</span></div>
      <div class="rxf-sub rxf-num" data-explorer="sure" title="${text(now.doubt)}">${now.sure ? `${text(now.change_within)} %: ${text(now.sure)}` : ''}</div></div>
      <div class="rxf-rule"></div>
      ${now.problem ? `<div class="rxf-problem" data-explorer="problem" role="alert">${text(now.problem)} <button data-do="nearest" data-explorer="nearest">Nearest that trims</button></div>` : `<div class="rxf-change"><div class="rxf-since rxf-num" data-explorer="since">${since}</div>
      <div class="rxf-why rxf-num" data-explorer="why" title="${text(now.why)}">${text(now.why.replace(/(\d) (kW|hp)/g, '$1\u00a0$2'))}</div></div>`}
      <div class="rxf-rule"></div>
      <div class="rxf-parts" role="button" tabindex="0" data-do="drawer" data-value="details" aria-label="Power and trim in detail: ${now.parts.map(one => `${text(one.name)} ${text(one.value)}`).join(', ')}" title="Power and trim in detail"><div>${bar}</div><dl>${key}</dl></div>
      <button class="rxf-chip" data-do="drawer" data-value="trust" data-explorer="status" data-kind="${now.status.kind === 'care' ? 'converged' : now.status.kind}" data-tone="${now.status.kind}" title="${text(now.status.title)}"><span>${text(now.status.words)}${now.status.measured ? `<small data-explorer="validated">${text(now.status.measured)}</small>` : ''}</span></button>`;
    // What has no room is left out clause by clause, never cut within one: the tooltip has it all.
    const why = place.querySelector('.rxf-why'), room = why && parseFloat(getComputedStyle(why).minHeight) + 1;
    for (const clauses = now.why.split('; '); clauses.length > 1 && why?.offsetHeight > room;) {
      clauses.pop();
      why.textContent = `${clauses.join('; ')}.`;
    }
    const chip = place.querySelector('.rxf-chip');
    if (now.status.kind === 'care') chip.style.cssText = 'background:var(--rx-warn);color:var(--rx-warn-ink)';
    if (now.problem) RX.say(now.problem);
  });

  // Vibration of blades that bend, a row of its own below the power, whose card is filled anew each time.
  function vibration(now) {
    const card = part('power'), html = document.documentElement;
    html.toggleAttribute('data-vibration', Boolean(now));
    card.querySelector('.rxf-vibration')?.remove();
    if (!now) return;
    const numbers = now.sentence ? `<span class="rxf-dim">${text(now.sentence)}</span>` : `<span class="rxf-num"><b data-explorer="index">${text(now.index)}</b> ${text(now.unit)}</span><span class="rxf-dim rxf-num" data-explorer="index-band">${text(now.band)}</span>
      ${now.change ? `<span class="rxf-num ${now.kind ? `rxf-${now.kind}` : ''}" data-explorer="index-change">${text(now.change)}</span>` : ''}`;
    card.insertAdjacentHTML('beforeend', `<div class="rxf-vibration" data-explorer="vibration" role="group" tabindex="0" aria-label="Vibration: ${text(now.sentence || `${now.index} ${now.unit}, ${now.band}${now.change ? `, ${now.change}` : ''}. ${now.title}`)}" title="${text(now.title)}"><b>Vibration${now.at ? ` ${text(now.at)}` : ''}</b>${numbers}</div>`);
  }
  RX.also('vibration', vibration);
  RX.also('power', () => vibration(RX.state.vibration));

  const REGIONS = {
    stall: ['Stall', '<rect width="20" height="11" fill="#8fcf7c"/><path d="M-3 11 8 0M3 11 14 0M9 11 20 0M15 11 26 0" stroke="var(--rx-stall)" stroke-width="2.2"/>'],
    reverse_flow: ['Reverse flow', '<rect x=".7" y=".7" width="18.6" height="9.6" fill="var(--rx-reverse)" stroke="#fff" stroke-width="1.4"/>'],
    wake: ['Tip vortices', '<path d="M0 8.500C6 1 13 1 20 6.5" stroke="var(--rx-accent)" stroke-width="1.800" fill="none"/>'],
    drag_divergence: ['Drag divergence', '<path d="M0 5.500H20" stroke="var(--rx-ink)" stroke-width="2" stroke-dasharray="4.5 2.5"/>'],
  };
  const line = (colour, dashes = '') => `<path d="M0 5.5H20" stroke="${colour}" stroke-width="2.4" stroke-dasharray="${dashes}"/>`;
  const PLANNED = [
    ['stall', 'Stall', line('var(--rx-stall)')], ['negative_stall', 'Negative stall', line('var(--rx-stall)', '7 3')],
    ['reverse_flow', 'Reverse flow', line('var(--rx-dim)')], ['drag_divergence', 'Drag divergence', line('var(--rx-ink)', '3 4')],
  ];
  RX.paint('field', now => {
    const card = document.querySelector('.rxf-field');
    card.hidden = !now;
    if (!now) return;
    const menu = card.querySelector('select'), names = now.fields.join('|');
    if (menu.dataset.names !== names) {
      menu.dataset.names = names;
      menu.innerHTML = now.fields.map(name => `<option>${text(name)}</option>`).join('');
    }
    if (menu.value !== now.field) menu.value = now.field;
    menu.disabled = now.held;
    part('unit').textContent = now.unit.replace(/^, /, '');  // What follows a unit stands alone where there is none.
    part('scale').className = now.faded ? 'rxf-faded' : '';
    part('scale').innerHTML = `<div class="rxf-grad" title="Triangles: values beyond the range"><i style="background:${now.colours[0]};visibility:${now.beyond[0] ? 'visible' : 'hidden'}"></i><i style="background:linear-gradient(90deg,${now.colours.join()})"></i><i style="background:${now.colours.at(-1)};visibility:${now.beyond[1] ? 'visible' : 'hidden'}"></i></div>${Charts.bar(now.ticks)}`;
    const fit = card.querySelector('.rxf-fit');
    fit.dataset.value = now.fitted ? 'Default' : 'Rescale';
    fit.textContent = now.fitted ? 'Reset' : 'Fit';
    fit.ariaLabel = now.fitted ? 'Reset the colour range' : 'Fit the colour range';
    const apart = now.difference === null ? '' : `<button data-do="difference" data-value="${now.difference ? 'off' : 'on'}" aria-pressed="${now.difference}">Show B − A</button><button data-do="region" data-value="wipe" aria-pressed="${now.wipe}">Wipe A | B</button>`;
    // The plan draws outlines, and each region has its own share there.
    const shares = RX.state.plan && Object.fromEntries(RX.state.plan.regions.map(one => [one.name, one.words.split(' · ')[0]]));
    const entries = shares ? PLANNED.filter(([name]) => name !== 'negative_stall' || name in shares) : Object.entries(REGIONS).map(([name, [title, swatch]]) => [name, title, swatch]);
    part('legend').innerHTML = entries.map(([name, title, swatch]) => {
      const region = name === 'negative_stall' ? 'stall' : name, share = shares ? shares[name] : name === 'stall' && now.stalled;
      return `<button data-do="region" data-value="${region}" aria-pressed="${now.regions[region]}" ${!shares && name === 'stall' ? 'title="Of the disk, at high and at negative angles of attack"' : ''}><svg viewBox="0 0 20 11" aria-hidden="true">${swatch}</svg>${title}${share ? shares ? ` <span class="rxf-num">${text(share)}</span>` : ` ${text(share)}` : ''}</button>`;
    }).join('') + apart;
  });

  RX.paint('turn', now => {
    const slider = document.querySelector('.rxf-turn input'), button = document.querySelector('.rxf-turn [data-do=play]'), pace = document.querySelector('.rxf-turn [data-do=pace]');
    if (document.activeElement !== slider || now.playing) slider.value = now.psi;
    slider.disabled = now.held;
    document.querySelector('.rxf-turn output').textContent = `ψ ${Math.round(now.psi)}°`;
    pace.textContent = now.pace;
    pace.ariaLabel = `Speed of the turning rotor: ${now.pace}`;
    const wanted = now.playing ? 'pause' : 'play';
    if (button.dataset.icon !== wanted) {
      button.dataset.icon = wanted;
      button.innerHTML = RX.icon(wanted);
      button.ariaLabel = now.playing ? 'Stop the rotor' : 'Turn the rotor';
    }
  });
})();
