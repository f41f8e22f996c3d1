// Actuate: tip twist over a flight that is scrubbed or played, and what the actuator earns.
(() => {
  const {text, part} = RX, page = document.documentElement;
  const card = part('fly'), earns = part('earns'), WHOLE = 14000, SEND = 70;  // [ms] of a played flight, and between two messages.
  const {clamp} = Charts, degrees = value => Charts.signed(value, 2) + '°';
  let at = 0, own = 0, sent = 0, waiting = 0, playing = 0, before = 0, moved = -Infinity;

  const last = () => RX.state.flight.legs.length - 1;
  const between = (values, x) => {
    const step = last() / (values.length - 1), k = clamp(Math.floor(x / step), 0, values.length - 2), u = x / step - k;
    return (1 - u) * values[k] + u * values[k + 1];
  };

  // By hand or by itself: the marker follows at once, the server hears of it a few times a second.
  function go(x) {
    at = clamp(x, 0, last());
    moved = performance.now();
    mark();
    const rest = sent + SEND - moved;
    clearTimeout(waiting);
    waiting = setTimeout(() => { sent = performance.now(); RX.send('fly', Math.round(1000 * at) / 1000); }, Math.max(0, rest));
  }
  function stop() {
    if (!playing) return;
    cancelAnimationFrame(playing);
    playing = 0;
    setTimeout(() => RX.send('hold', false), SEND + 80);
    button();
  }
  function play() {
    if (playing) return stop();
    if (at > last() - 0.02) go(0);
    before = performance.now();
    RX.send('hold', true);
    const step = now => {
      playing = requestAnimationFrame(step);
      go(at + last() * Math.min(now - before, 200) / WHOLE);
      before = now;
      if (at >= last()) stop();
    };
    playing = requestAnimationFrame(step);
    button();
  }
  function button() {
    const place = card.querySelector('[data-fly=play]');
    if (!place) return;
    place.innerHTML = RX.icon(playing ? 'pause' : 'play');
    place.ariaLabel = playing ? 'Stop the flight' : 'Fly from hover to fast';
  }

  card.addEventListener('click', event => {
    const near = event.target.closest('[data-fly]');
    if (!near) return;
    if (near.dataset.fly === 'play') return play();
    stop();
    go(Number(near.dataset.fly));
  });
  card.addEventListener('input', event => { if (event.target.type === 'range') { stop(); go(Number(event.target.value)); } });
  card.addEventListener('pointerdown', event => {
    if (event.target.type !== 'range') return;
    own++;
    RX.send('hold', true);
    addEventListener('pointerup', () => { own = 0; setTimeout(() => RX.send('hold', false), SEND + 80); }, {once: true});
  });

  let scale = null;
  RX.paint('flight', now => {
    if (page.toggleAttribute('data-flight', Boolean(now)) !== !card.hidden) { RX.again('power', 'inset', 'strip'); dispatchEvent(new Event('resize')); }
    card.hidden = !now;
    if (!now) { stop(); card.innerHTML = ''; return; }
    if (!own && !playing && performance.now() - moved > 900) at = clamp(now.at, 0, last());
    if (!card.firstChild) {
      card.innerHTML = `<div class="rxf-head"><b>Tip twist</b><b class="rxf-num" data-explorer="tip-twist"></b><span class="rxf-dim rxf-num" data-words></span></div>
        <svg role="img"></svg><div class="rxf-fly-bar"><button data-fly="play"></button><input type="range" min="0" step="0.01" data-do="fly" aria-label="Flight"><div></div></div>`;
      button();
    }
    const slider = card.querySelector('input'), legs = card.querySelector('.rxf-fly-bar > div');
    slider.max = last();
    const names = JSON.stringify(now.legs);
    if (legs.dataset.names !== names) {
      legs.dataset.names = names;
      legs.innerHTML = now.legs.map(([name, words], k) => `<button data-fly="${k}" style="left:${100 * k / last()}%" title="Fly ${text(name)}: ${text(words)}"><b>${text(name)}</b><small>${text(words)}</small></button>`).join('');
    }
    card.toggleAttribute('data-faded', now.kind !== 'ready');
    card.dataset.kind = now.kind;
    draw(now);
    mark();
  });

  // Everything but the marker.
  function draw(now) {
    const svg = card.querySelector('svg'), width = card.clientWidth - 28, height = svg.clientHeight;
    if (width < 120 || height < 30) return;
    scale = Charts.frame(now.chart, width, height, {left: 46, right: 16, bottom: 8});
    svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    svg.innerHTML = `${Charts.rows(now.chart, scale)}${Charts.inside(now.chart, scale)}<g data-marker></g>`;
  }

  function mark() {
    const now = RX.state.flight, slider = card.querySelector('input');
    if (!now || !slider || !scale) return;
    if (document.activeElement !== slider || Math.abs(Number(slider.value) - at) > 0.011) slider.value = at;
    slider.style.setProperty('--at', `${100 * at / last()}%`);
    const {X, Y, height} = scale, x = X(at), near = now.legs[Math.round(at)];
    card.querySelectorAll('.rxf-fly-bar [data-fly]:not([data-fly=play])').forEach((one, k) => one.toggleAttribute('data-here', Math.abs(k - at) < .02));
    let inside = `<path d="M${x.toFixed(1)} 2V${height}" class="rxf-fly-now"/>`, words = now.words, said = '';
    if (now.chart.series.length) {
      const [wanted, reached] = ['wanted', 'reached'].map(name => between(now.chart.series.find(one => one.label === name).y, at));
      inside += `<circle cx="${x}" cy="${Y(wanted)}" r="5" class="rxf-fly-dot" data-wanted/><circle cx="${x}" cy="${Y(now.frozen ?? reached)}" r="6.5" class="rxf-fly-dot"/>`;
      said = now.flown ? degrees(reached) : now.tip;
      const works = `${degrees(reached)} of ${degrees(wanted)} wanted`;
      words = `${now.flown ? `of ${degrees(wanted)} wanted` : now.frozen === null ? `now; reaches ${works}` : `stopped; working, it reaches ${works}`}${now.kind === 'ready' ? '' : ' · computing…'}`;
      slider.ariaValueText = `${near[0]}: ${said} ${words}`;
    } else slider.ariaValueText = near[0];
    const group = card.querySelector('[data-marker]');
    if (group) group.innerHTML = inside;
    const place = card.querySelector('[data-words]');
    if (place.textContent !== words) place.textContent = words;
    card.querySelector('[data-explorer=tip-twist]').textContent = said;
  }

  // One waterfall: where the power goes.
  RX.paint('earns', now => {
    earns.hidden = !now;
    RX.again('power');
    if (!now) { earns.innerHTML = ''; return; }
    const {suppose} = RX.state;
    earns.toggleAttribute('data-faded', now.kind !== 'ready' && !suppose);
    earns.toggleAttribute('data-suppose', Boolean(suppose));
    if (suppose) return breakEven(suppose);
    earns.innerHTML = `<div class="rxf-head"><b>Power it needs</b><span class="rxf-dim">${text(now.unit)}, ${text(now.where)}</span><button class="rxf-push" data-do="suppose" data-value="on" title="Suppose another actuator: drag its twist and its mass">What would pay?</button></div>
      <svg role="img"></svg>
      <div class="rxf-earns-foot"><span class="rxf-dim" title="${text(now.mass_note)}">${text(now.mass)}</span><b class="rxf-push rxf-num" data-kind="${now.fuel_kind}" data-explorer="fuel" title="${text(now.fuel_note)}">${text(now.fuel)}</b></div>`;
    const svg = earns.querySelector('svg'), width = earns.clientWidth - 28, height = svg.clientHeight, bars = now.bars;
    if (!bars.length || width < 100 || height < 40) { svg.innerHTML = ''; return; }
    let sum = 0;
    const ends = bars.map(bar => { const from = bar.total ? 0 : sum; sum = bar.total ? bar.value : sum + bar.value; return [from, sum]; });
    const all = [0, ...ends.flat()], low = Math.min(...all), high = Math.max(...all), span = Math.max(high - low, 1e-6);
    const Y = v => 20 + (high - v) / span * (height - 62), room = width / bars.length, wide = Math.min(64, 0.66 * room);
    let inside = `<path d="M0 ${Y(0).toFixed(1)}H${width}" stroke="var(--rx-faint)"/>`;
    bars.forEach((bar, k) => {
      const [from, to] = ends[k], x = room * (k + .5), top = Math.min(Y(from), Y(to)), tall = Math.max(2, Math.abs(Y(to) - Y(from))), up = to > from;
      if (k) inside += `<path d="M${room * (k - .5) + wide / 2} ${Y(ends[k - 1][1]).toFixed(1)}H${x + (bar.total ? wide / 2 : -wide / 2)}" class="rxf-earns-link"/>`;
      inside += `<rect x="${x - wide / 2}" width="${wide}" y="${top.toFixed(1)}" height="${tall.toFixed(1)}" rx="3" class="rxf-earns-bar" data-kind="${bar.kind}" ${bar.total ? 'data-total' : ''}/>
        <text x="${x}" y="${(up ? top - 5 : top + tall + (bar.total ? 18 : 14)).toFixed(1)}" text-anchor="middle" class="rxf-earns-number rxf-num" data-kind="${bar.kind}" ${bar.total ? 'data-total data-explorer="net"' : ''}>${text(bar.text)}</text>
        <text x="${x}" y="${height - 3}" text-anchor="middle" class="rxf-earns-name" ${bar.total ? 'data-total' : ''}>${text(bar.name)}</text>`;
    });
    svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    svg.ariaLabel = bars.map(bar => `${bar.name} ${bar.text}`).join(', ');
    svg.innerHTML = inside;
  });
  RX.paint('suppose', () => RX.again('earns'));

  // The break-even line, and a supposed actuator to drag by its twist and mass; real ones stand where they are.
  let held = null, told_at = 0, queued = 0;
  const driven = ({series}, {X, Y}) => {
    const {x, y} = series.find(one => one.dashes), end = y.length - 1;
    return y[end] === null ? '' : `<text x="${X(x[end]).toFixed(1)}" y="${(Y(y[end]) + 13).toFixed(1)}" text-anchor="end">half goes to the drive</text>`;
  };
  // A name that would lie on another stands below or beside its point, or waits for the pointer.
  function apart(svg) {
    const taken = [...svg.querySelectorAll('g > title ~ circle')].map(dot => [+dot.getAttribute('cx') - 5, +dot.getAttribute('cy') + 5, 10]);
    for (const word of svg.querySelectorAll('[data-name]')) {
      const dot = word.parentNode.querySelector('circle').getBBox(), wide = word.getBBox().width, x = dot.x + dot.width / 2, y = dot.y + dot.height / 2;
      const places = [[x - wide / 2, y - 8], [x - wide / 2, y + 18], [x + 9, y + 4], [x - wide - 9, y + 4], [x, y - 8], [x, y + 18]].filter(([left]) => left > earns.place.left);
      const free = places.find(([left, low]) => taken.every(one => left > one[0] + one[2] + 3 || left + wide + 3 < one[0] || Math.abs(low - one[1]) > 12));
      if (!free) { word.remove(); continue; }
      taken.push([...free, wide]);
      word.setAttribute('text-anchor', 'start');
      word.setAttribute('x', free[0].toFixed(1));
      word.setAttribute('y', free[1].toFixed(1));
    }
  }
  function breakEven(now) {
    const focused = earns.contains(document.activeElement) && document.activeElement.dataset.supposed !== undefined;
    earns.innerHTML = `<div class="rxf-head"><b>What would pay</b><span class="rxf-dim">range of twist, mass of all blades</span><button class="rxf-push" data-do="suppose" data-value="off">Power it needs</button></div>
      <div class="rxf-num rxf-supposed" data-kind="${now.kind}" data-explorer="supposed">${text(now.words)}</div><svg></svg>${now.note ? `<div class="rxf-earns-pays rxf-dim" data-explorer="pays" title="${text(now.note)}">${text(now.note)}</div>` : ''}`;
    const svg = earns.querySelector('svg'), width = earns.clientWidth - 28, height = svg.clientHeight;
    if (!now.chart || width < 100 || height < 40) return;
    const place = Charts.frame(now.chart, width, height, {bottom: 32}), [x, y] = held?.at ?? now.at, {left, right, top, base} = place;
    svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    svg.innerHTML = `${Charts.axes(now.chart, place)}${Charts.inside(now.chart, place)}${width > 420 ? driven(now.chart, place) : ''}<text x="${right - 6}" y="${base - 4}" text-anchor="end" data-pays>pays</text>${width > 420 ? `<text x="${right - 6}" y="${top + 12}" text-anchor="end" data-costs>mass costs more than twist saves</text>` : ''}
      <circle data-supposed data-kind="${now.kind}" cx="${clamp(place.X(x), left, right)}" cy="${clamp(place.Y(y), top, base)}" r="10" tabindex="0" role="slider" aria-label="Supposed actuator" aria-valuenow="${x}" aria-valuetext="${text(now.words)}"><title>Drag: range of twist and mass of all blades</title></circle>`;
    earns.place = place;
    apart(svg);
    if (focused) svg.querySelector('[data-supposed]').focus({preventScroll: true});
  }
  const suppose = (twist, mass) => {
    const {left, right, top, base, atX, atY, X, Y} = earns.place;
    const px = clamp(X(twist), left + 1, right), py = clamp(Y(mass), top, base), dot = earns.querySelector('[data-supposed]');
    dot?.setAttribute('cx', px);
    dot?.setAttribute('cy', py);
    clearTimeout(queued);
    queued = setTimeout(() => { told_at = performance.now(); RX.send('suppose', [atX(px), atY(py)]); }, Math.max(0, 60 - (performance.now() - told_at)));
    return [atX(px), atY(py)];
  };
  earns.addEventListener('pointerdown', event => {
    if (event.button || !event.target.closest('[data-supposed]')) return;
    event.preventDefault();
    event.target.focus({preventScroll: true});
    held = {at: RX.state.suppose.at};
  });
  addEventListener('pointermove', event => {
    if (!held || !earns.place) return;
    const box = earns.querySelector('svg').getBoundingClientRect(), {atX, atY} = earns.place;
    held.at = suppose(atX(event.clientX - box.left), atY(event.clientY - box.top));
  });
  for (const name of ['pointerup', 'pointercancel']) addEventListener(name, () => { held = null; });
  earns.addEventListener('keydown', event => {
    const step = event.target.dataset?.supposed !== undefined && {ArrowLeft: [-.1, 1], ArrowRight: [.1, 1], ArrowDown: [0, 1 / 1.05], ArrowUp: [0, 1.05]}[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    const [x, y] = RX.state.suppose.at, many = event.shiftKey ? 5 : 1;
    RX.state.suppose.at = suppose(x + many * step[0], y * step[1] ** many);
  });
  // The card of power tells the one verdict, here and over the flight, against one blade.
  const told = () => {
    const now = RX.state.earns, place = now && part('power').querySelector('[data-explorer=verdict]');
    if (!place) return;
    const [words, kind] = now.problem ? [now.problem, ''] : RX.verdict();
    place.textContent = words;
    place.dataset.tone = kind;
  };
  RX.told = told;
  RX.also('dial', told);
  RX.also('power', () => {
    const now = RX.state.earns, change = part('power').querySelector('.rxf-change');
    if (!now || !change) return;
    change.innerHTML = `<div class="rxf-why">Against <button data-do="against" title="Compare with the other blade">${text(now.against)} ⇄</button></div><div class="rxf-since rxf-num" data-explorer="verdict" data-kind="${now.kind}" title="This actuator on board, in this flight. Bands: over inflow models"></div><div class="rxf-why" data-explorer="mission">${text(now.mission)}</div>`;
    told();
    const under = part('power').querySelector('.rxf-sub');
    if (under) under.textContent = 'at this twist, without its mass';
  });
  for (const [name, place] of [['flight', card], ['earns', earns]]) new ResizeObserver(() => { if (RX.state[name]) RX.again(name); }).observe(place);
})();
