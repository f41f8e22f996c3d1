// @ts-check
// Actuate: tip twist over a flight that is scrubbed or played, and what the actuator earns.
(() => {
  const {text, clamp, lerp, write, outdate, closest, paced, drag} = Common, {part} = RX;
  const card = part('fly'), earns = part('earns');
  const WHOLE = 14000, SEND = 70, LATER = SEND + 80;  // [ms] A played flight; between two messages; after the last.
  const degrees = value => `${Common.signed(value, 2)}°`;
  let at = 0, scrubbed = false, moved = -Infinity, settled = 0, playing = 0, release = null;

  const last = () => RX.shown('flight').legs.length - 1;
  const between = (values, x) => {
    const step = last() / (values.length - 1), k = clamp(Math.floor(x / step), 0, values.length - 2);
    return lerp(values[k], values[k + 1], x / step - k);
  };

  // By hand or by itself: the marker follows at once, the server hears of it a few times a second.
  const flown = paced(x => RX.send('fly', Math.round(1000 * x) / 1000), SEND);
  function go(x) {
    at = clamp(x, 0, last());
    moved = performance.now();
    mark();
    flown.send(at);
    clearTimeout(settled);  // An undo may have come meanwhile.
    settled = setTimeout(() => { if (RX.state.flight) RX.again('flight'); }, 950);
  }
  function stop() {
    if (!playing) return;
    cancelAnimationFrame(playing);
    playing = 0;
    release();
    drawButton();
  }
  function play() {
    if (playing) return stop();
    if (at > last() - 0.02) go(0);
    let before = performance.now();
    release = RX.hold(LATER);
    const step = now => {
      playing = requestAnimationFrame(step);
      go(at + last() * Math.min(now - before, 200) / WHOLE);
      before = now;
      if (at >= last()) stop();
    };
    playing = requestAnimationFrame(step);
    drawButton();
  }
  function drawButton() {
    const button = card.querySelector('[data-fly=play]');
    if (!button) return;
    write(button, RX.icon(playing ? 'pause' : 'play'));
    button.ariaLabel = playing ? 'Stop the flight' : 'Fly from hover to fast';
  }

  card.addEventListener('click', event => {
    const leg = closest(event, '[data-fly]')?.dataset.fly;
    if (!leg) return;
    if (leg === 'play') return play();
    stop();
    go(Number(leg));
  });
  card.addEventListener('input', ({target}) => { if (target.type === 'range') { stop(); go(Number(target.value)); } });
  drag(card, 'input[type=range]', () => {
    const letGo = RX.hold(LATER);
    scrubbed = true;
    return {end() { scrubbed = false; letGo(); }};
  });

  const STATES = {
    set: 'The sliders set the voltage', schedule: 'The voltage follows the flight, for least power',
    stopped: 'The actuator fails: its twist freezes while the flight continues',
  };
  let scale = null;
  RX.paint('flight', flight => {
    if (document.documentElement.toggleAttribute('data-flight', Boolean(flight)) === card.hidden)
      dispatchEvent(new Event('resize'));
    card.hidden = !flight;
    if (!flight) { stop(); write(card, ''); return; }
    if (!scrubbed && !playing && performance.now() - moved > 900) at = clamp(flight.at, 0, last());
    const states = flight.states.map(([name, words]) => `<button data-do="state" data-value="${name}"
      aria-label="Actuator ${text(words)}" aria-pressed="${name === flight.state}"
      title="${STATES[name]}">${text(words)}</button>`);
    write(card, `<div class="rxf-head"><b>Tip twist</b><b class="rxf-num" data-answers data-explorer="tip-twist"></b>
        <span role="group" class="rxf-push" aria-label="Actuator">${states.join('')}</span></div>
      <div class="rxf-num" data-answers data-words></div>
      <svg data-answers role="img" aria-label="Twist at the tip over the flight"></svg>
      <div class="rxf-fly-bar"><button data-fly="play"></button>
        <input type="range" min="0" step="0.01" data-do="fly" aria-label="Flight"><div></div></div>`);
    drawButton();
    card.querySelector('input').max = last();
    write(card.querySelector('.rxf-fly-bar > div'), flight.legs.map(([name, words], k) => `
      <div style="left:${100 * k / last()}%"><button data-fly="${k}" title="Fly ${text(name)}: ${text(words)}">
        <b>${text(name)}</b></button>
        <label><input type="number" min="0" max="99" step="0.05" inputmode="decimal" data-hours="${k}"
          aria-label="Hours of ${text(name)} in the mission"> h</label>
        <small>${text(words)}</small></div>`).join(''));
    showHours(flight);
    outdate(card, flight.kind !== 'ready');
    card.dataset.kind = flight.kind;
    write(card.querySelector('[data-words]'),
      keys(flight).map(([key, words]) => `<span data-key="${key}">${text(words)}</span>`).join(''));
    card.querySelector('[data-explorer=tip-twist]').textContent = flight.tip;
    draw(flight.chart);
    mark();
  });
  // The hours of the mission: what a hand writes stays until it leaves the field.
  function showHours({hours, assumed}) {
    card.querySelectorAll('[data-hours]').forEach((field, k) => {
      if (document.activeElement !== field) field.value = hours[k];
      field.title = assumed ? 'Hours of this leg in the mission: assumed' : 'Hours of this leg in the mission';
      field.toggleAttribute('data-assumed', assumed);
    });
  }
  // Fields of the flight bar, and of the Schedule section where a rotor has no flight bar.
  addEventListener('change', ({target}) => {
    const field = /** @type {HTMLInputElement} */ (target), leg = field.dataset.hours, {value} = field;
    if (leg && value !== '') RX.send('hours', [Number(leg), clamp(Number(value), 0, 99)]);
  });
  card.addEventListener('focusout', ({target}) => {
    if (target.dataset.hours) setTimeout(() => { if (RX.state.flight) showHours(RX.state.flight); }, 600);
  });
  // Names of the lines and areas. All words are written before the drawing, which has the height that they leave.
  function keys({state, words, chart, kind}) {
    const {length} = chart.series, named = [[state, words]];
    if (length) named.push(['reach', 'reach']);
    if (state !== 'schedule' && length > 1) named.push(['reached', 'by schedule']);
    if (kind === 'computing') named.push(['', 'schedule: computing…']);
    return named;
  }

  // Everything but the marker.
  function draw(chart) {
    const svg = card.querySelector('svg'), width = card.clientWidth - 28, height = svg.clientHeight;
    if (width < 120 || height < 30) return;
    scale = Charts.frame(chart, width, height, {left: 46, right: 16, bottom: 8});
    svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    svg.innerHTML = `${Charts.rows(chart, scale)}${Charts.inside(chart, scale)}<g data-marker></g>`;
  }

  function mark() {
    const {flight} = RX.state, slider = card.querySelector('input');
    if (!flight || !slider || !scale) return;
    if (document.activeElement !== slider || Math.abs(Number(slider.value) - at) > 0.011) slider.value = at;
    slider.style.setProperty('--at', `${100 * at / last()}%`);
    card.querySelectorAll('.rxf-fly-bar > div button')
      .forEach((leg, k) => leg.toggleAttribute('data-here', Math.abs(k - at) < .02));
    const {X, Y, height} = scale, x = X(at).toFixed(1), {series} = flight.chart;
    let marker = `<path d="M${x} 2V${height}" class="rxf-fly-now"/>`, {tip} = flight;
    // By schedule foreseen until the server is where the marker is: from then on what the voltages make.
    const named = flight.states.find(([name]) => name === flight.state)?.[1];
    const line = series.find(({label}) => label === named);
    if (line) {
      const there = between(/** @type {any} */ (line).y, at);
      marker += `<circle cx="${x}" cy="${Y(there)}" r="6.5" class="rxf-fly-dot"/>`;
      if (flight.state === 'schedule' && Math.abs(flight.at - at) > .02) tip = degrees(there);
    }
    slider.ariaValueText = [flight.legs[Math.round(at)][0], tip, ...keys(flight).map(([, words]) => words)].join(' ');
    const group = card.querySelector('[data-marker]');
    if (group) group.innerHTML = marker;
    card.querySelector('[data-explorer=tip-twist]').textContent = tip;
  }

  // The word mission in the verdict leads to its hours, which are edited here only.
  addEventListener('click', event => {
    if (!closest(event, '[data-mission]')) return;
    if (RX.small.matches) RX.showTab('charts', true);
    const field = card.querySelector('[data-hours]');
    if (!field.checkVisibility()) document.querySelector('.rxf-open [data-unfold=flight]').click();
    field.focus();
    field.select();
  });

  let listed = false;  // The table of kinds was asked for, which stands among the controls.
  addEventListener('click', event => { listed ||= Boolean(closest(event, '[data-explorer=kinds]')); }, true);
  // One waterfall: where the power goes. Or the line where an actuator pays for itself.
  RX.paint(['earns', 'suppose'], (balance, other) => {
    earns.hidden = !balance;
    if (!balance) { earns.innerHTML = ''; return; }
    outdate(earns, balance.kind !== 'ready' && !other);
    const begins = other && !earns.hasAttribute('data-suppose');
    earns.toggleAttribute('data-suppose', Boolean(other));
    if (begins && RX.small.matches && !listed) {  // Its drawing goes to the head of the sheet, whatever began it.
      RX.showTab('charts', true);
      earns.closest('.rxf-sheet').scrollTop = 0;
    }
    listed = false;
    if (other) drawBreakEven(other);
    else drawBalance(balance);
  });
  // The drawing of this card, and its size, where it has room.
  function room() {
    const svg = earns.querySelector('svg'), width = earns.clientWidth - 28, height = svg.clientHeight;
    if (width < 100 || height < 40) return {};
    svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    return {svg, width, height};
  }
  function drawBalance({bars, unit, here, where, fuel, fuel_kind, fuel_note}) {
    const scopes = [['here', 'here', here], ['flight', 'over the mission', !here]].map(([name, words, chosen]) =>
      `<button data-do="balance" data-value="${name}" aria-pressed="${chosen}">${words}</button>`);
    const net = bars.find(bar => bar.total);
    const earned = net && `${text(net.text)} ${text(unit)}`;
    const headline = net ? `<b class="rxf-num rxf-earns-sum" data-kind="${net.kind}">${earned}</b>` : '';
    earns.innerHTML = `<div class="rxf-head"><b>Extra power</b>${headline}<span role="group">${scopes.join('')}</span>
        <span class="rxf-dim">${text([unit, where].filter(Boolean).join(', '))}</span>
        <button class="rxf-push" data-do="suppose" data-value="on"
          title="Try another actuator: drag its twist and mass">What would pay?</button></div>
      <svg data-answers role="img" aria-label="Extra power by its parts"></svg>
      <div class="rxf-earns-foot" data-answers><b class="rxf-push rxf-num" data-kind="${fuel_kind}" data-explorer="fuel"
          title="${text(fuel_note)}">${text(fuel)}</b></div>`;
    const {svg, width, height} = room();
    if (!bars.length || !svg || !width) return;
    let sum = 0;
    const ends = bars.map(({total, value}) => {
      const from = total ? 0 : sum;
      sum = from + value;
      return [from, sum];
    });
    const bands = bars.flatMap(({band}, k) => [ends[k][1] - band, ends[k][1] + band]);
    const all = [0, ...ends.flat(), ...bands], high = Math.max(...all), span = Math.max(high - Math.min(...all), 1e-6);
    const Y = value => 20 + (high - value) / span * (height - 62);
    const step = width / bars.length, wide = Math.min(64, 0.66 * step);
    const drawn = bars.map(({kind, total, name, text: words, band, title}, k) => {
      const [from, to] = ends[k], x = step * (k + .5), top = Math.min(Y(from), Y(to));
      const tall = Math.max(2, Math.abs(Y(to) - Y(from))), above = to > from ? top - 5 : top + tall + (total ? 18 : 14);
      const link = k ? `M${x - step + wide / 2} ${Y(ends[k - 1][1]).toFixed(1)}H${x + (total ? wide : -wide) / 2}` : '';
      const within = band ? `M${x + wide / 2 - 4} ${Y(to - band).toFixed(1)}V${Y(to + band).toFixed(1)}` : '';
      return `<g><title>${text(title)}</title><path d="${link}" class="rxf-earns-link"/>
        <rect x="${x - wide / 2}" width="${wide}" y="${top.toFixed(1)}" height="${tall.toFixed(1)}" rx="3"
          class="rxf-earns-bar" data-kind="${kind}" ${total ? 'data-total' : ''}/>
        <path d="${within}" class="rxf-earns-band"/>
        <text x="${x}" y="${above.toFixed(1)}" text-anchor="middle" class="rxf-earns-number rxf-num" data-kind="${kind}"
          ${total ? 'data-total data-explorer="net"' : ''}>${text(words)}</text>
        <text x="${x}" y="${height - 3}" text-anchor="middle" class="rxf-earns-name" ${total ? 'data-total' : ''}>
          ${text(name)}</text></g>`;
    });
    svg.ariaLabel = bars.map(bar => bar.title || `${bar.name} ${bar.text}`).join(', ');
    svg.innerHTML = `<path d="M0 ${Y(0).toFixed(1)}H${width}" stroke="var(--rx-faint)"/>${drawn.join('')}`;
  }

  // The break-even line, and a supposed actuator to drag by its twist and mass; real ones stand where they are.
  let held = null;
  function drawBreakEven({chart, kind, words, note, at: given}) {
    const focused = earns.contains(document.activeElement) && document.activeElement?.matches('[data-supposed]');
    earns.innerHTML = `<div class="rxf-head"><b>What would pay</b>
        <button class="rxf-push" data-do="suppose" data-value="off">Extra power</button></div>
      <div class="rxf-num rxf-supposed" data-answers data-kind="${kind}" data-explorer="supposed">${text(words)}</div>
      <svg data-answers></svg>
      <div class="rxf-earns-pays rxf-dim" data-answers data-explorer="pays" title="${text(note)}"
        ${note ? '' : 'hidden'}>${text(note)}</div>`;
    const {svg, width, height} = room();
    if (!chart || !svg || !width) return;
    const place = Charts.frame(chart, width, height, {top: 22, bottom: 32}), {X, Y, left, right, top, base} = place;
    const [twist, mass] = held?.at ?? given;
    const spot = [clamp(X(twist), left, right), clamp(Y(mass), top, base)];
    /** @type {[string, number, number, string][]} */
    const signs = [['pays', right - 6, base - 4, 'pays']];
    if (width > 420) signs.push(['costs', right - 6, 12, 'mass costs more than twist saves']);
    const taken = signs.map(([, to, low, word]) => [to - 6.2 * word.length, low - 10, to, low + 3]);
    taken.push([spot[0] - 11, spot[1] - 11, spot[0] + 11, spot[1] + 11]);
    const said = signs.map(([name, to, low, word]) =>
      `<text x="${to}" y="${low}" text-anchor="end" data-${name}>${word}</text>`);
    svg.innerHTML = `${Charts.axes(chart, place)}${Charts.inside(chart, place, taken)}${said.join('')}
      <text x="0" y="12" data-axis>${text(chart.y.label)}</text>
      <circle data-supposed data-kind="${kind}" cx="${spot[0]}" cy="${spot[1]}"
        r="10" tabindex="0" role="slider" aria-label="Supposed actuator" aria-valuenow="${twist}"
        aria-valuetext="${text(words)}">
        <title>Drag: range of twist and mass on board</title></circle>`;
    earns.place = place;
    if (focused) svg.querySelector('[data-supposed]').focus({preventScroll: true});
  }
  const supposed = paced(point => RX.send('suppose', point), 60);
  /** @returns {[number, number]} */
  function suppose(twist, mass) {
    const {left, right, top, base, atX, atY, X, Y} = earns.place, dot = earns.querySelector('[data-supposed]');
    const x = clamp(X(twist), left + 1, right), y = clamp(Y(mass), top, base);
    dot?.setAttribute('cx', x);
    dot?.setAttribute('cy', y);
    supposed.send([atX(x), atY(y)]);
    return [atX(x), atY(y)];
  }
  drag(earns, '[data-supposed]', (dot, event) => {
    event.preventDefault();
    dot.focus({preventScroll: true});
    held = {at: RX.shown('suppose').at};
    return {
      move({clientX, clientY}) {
        const box = earns.querySelector('svg').getBoundingClientRect(), {atX, atY} = earns.place;
        held.at = suppose(atX(clientX - box.left), atY(clientY - box.top));
      },
      end() { held = null; },
    };
  });
  const STEPS = {ArrowLeft: [-.1, 1], ArrowRight: [.1, 1], ArrowDown: [0, 1 / 1.05], ArrowUp: [0, 1.05]};
  earns.addEventListener('keydown', event => {
    const step = closest(event, '[data-supposed]') && STEPS[event.key], {suppose: shown} = RX.state;
    if (!step || !shown?.at) return;
    event.preventDefault();
    event.stopPropagation();
    const [twist, mass] = shown.at, many = event.shiftKey ? 5 : 1;
    shown.at = suppose(twist + many * step[0], mass * step[1] ** many);
  });
  for (const [name, element] of [['flight', card], ['earns', earns]])
    new ResizeObserver(() => { if (RX.state[name]) RX.again(name); }).observe(element);
})();
