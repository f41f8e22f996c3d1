// The charts of the page and of the lecture's file: one drawing of what `rotor.chart` says as JSON. Ticks, ends of the
// axes and colours come with it.
window.Charts = (() => {
  const text = value => String(value ?? '').replace(/[&<>"]/g, c => ({'&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;'})[c]);
  const clamp = (v, low, high) => Math.min(Math.max(v, low), high);
  const digits = value => (value < 0 ? '−' : '') + Math.abs(value).toLocaleString('en', {maximumFractionDigits: Math.abs(value) < 10 ? 3 : 1, useGrouping: false});
  // With so many decimals and a true minus sign; what rounds to zero has no sign.
  const fixed = (value, decimals = 0) => (value < 0 && Math.abs(value) >= .5 * 10 ** -decimals ? '−' : '') + Math.abs(value).toFixed(decimals);
  const signed = (value, decimals = 1) => (value >= .5 * 10 ** -decimals ? '+' : '') + fixed(value, decimals);
  // Of a colour bar.
  const bar = ticks => `<div class="rxf-ticks rxf-num">${ticks.map(([at, word]) => `<span style="left:${at}%">${text(word)}</span>`).join('')}</div>`;

  // Where values lie in a drawing, and the values of a place.
  function frame(one, width, height, {left, right = 8, top = 8, bottom = 17} = {}) {
    left ??= 12 + 7 * Math.max(3, ...one.y.ticks.map(([, word]) => word.length));
    const base = height - bottom, axis = ({range: [low, high], log}, from, to) => ({
      to: v => clamp(from + ((log ? Math.log10(Math.max(v, 1e-300)) : v) - low) / (high - low) * (to - from), -1e6, 1e6),
      back: place => { const v = low + (place - from) / (to - from) * (high - low); return log ? 10 ** v : v; },
    });
    const x = axis(one.x, left, width - right), y = axis(one.y, base, top);
    return {X: x.to, Y: y.to, atX: x.back, atY: y.back, left, right: width - right, top, base, width, height};
  }
  // Numbers between the ends of an axis wait, where there are many charts, for the pointer: `data-between`.
  const between = (k, ticks) => k > 0 && k < ticks.length - 1 ? ' data-between' : '';
  const rows = (one, {Y, left, right}) => one.y.ticks.map(([v, word], k) => `<path d="M${left} ${Y(v).toFixed(1)}H${right}" stroke="var(${v === 0 ? '--rx-faint' : '--rx-grid'})"/>
    <text x="${left - 6}" y="${(Y(v) + 4).toFixed(1)}" text-anchor="end"${between(k, one.y.ticks)}>${text(word)}</text>`).join('');
  // A short name stands left of the first number, a long one in the middle below, between the ends where only these are told.
  const long = one => (one.x.label ?? '').length > 5, ends = one => one.x.ends;
  function axes(one, place) {
    const {X, left, right, base} = place, last = one.x.ticks.length - 1, low = base + 15;
    const columns = one.x.ticks.map(([v, word], k) => {
      const wide = k === last && X(v) + 3.5 * word.length > right + 8;
      return `<text x="${(wide ? right + 8 : X(v)).toFixed(1)}" y="${low}" text-anchor="${ends(one) && !k ? 'start' : wide || (k === last && ends(one)) ? 'end' : 'middle'}"${between(k, one.x.ticks)}>${text(word)}</text>`;
    });
    const name = long(one) ? `<text x="${(left + right) / 2}" y="${low + (ends(one) ? 0 : 15)}" text-anchor="middle" data-axis>${text(one.x.label)}</text>`
      : `<text x="${left - 9}" y="${low}" text-anchor="end" data-axis>${text(one.x.label)}</text>`;
    return rows(one, place) + columns.join('') + name;
  }
  const edge = (xs, ys, {X, Y}) => xs.map((x, k) => `${X(x).toFixed(1)} ${Y(ys[k]).toFixed(1)}`);
  const DRAWN = {
    line({x, y, colour, width = 2, dashes, dots, filled}, {X, Y}) {
      let path = '', open = false, first = null, last = null;
      x.forEach((at, k) => {
        if (y[k] === null) { open = false; return; }
        path += `${open ? 'L' : 'M'}${X(at).toFixed(1)} ${Y(y[k]).toFixed(1)}`;
        first ??= at; last = at; open = true;
      });
      if (!path) return '';
      const area = filled ? `<path d="${path}L${X(last).toFixed(1)} ${Y(0).toFixed(1)}L${X(first).toFixed(1)} ${Y(0).toFixed(1)}Z" fill="${colour}" opacity=".1"/>` : '';
      return `${area}<path d="${path}" fill="none" stroke="${colour}" stroke-width="${width}" stroke-linejoin="round" ${dashes ? `stroke-dasharray="${dashes}"` : ''}/>${dots ? DRAWN.points({x, y, colour, size: 3}, {X, Y}) : ''}`;
    },
    band({x, low, high, colour}, place) {
      const known = x.map((_, k) => k).filter(k => low[k] !== null && high[k] !== null), of = list => known.map(k => list[k]);
      return known.length ? `<path d="M${[...edge(of(x), of(low), place), ...edge(of(x), of(high), place).reverse()].join('L')}Z" fill="${colour}" opacity=".17" data-band/>` : '';
    },
    points({x, y, colour, mark = 'dot', size = 4, words = [], action, press = [], names = [], beside, faint = [], scatter = []}, {X, Y, low, high, left, right, base}) {
      return x.map((at, k) => {
        if (y[k] === null) return '';
        const cx = X(at).toFixed(1), cy = (low === undefined || mark === 'ring' ? Y(y[k]) : clamp(Y(y[k]), low, high)).toFixed(1), said = words[k] ?? '';
        const dx = cx - left < 60 ? ['start', -size] : right - cx < 60 ? ['end', size] : ['middle', 0], up = beside === 'upward';
        const name = names[k] ? `<text ${up ? `transform="translate(${+cx + 4} ${cy - size - 4}) rotate(-90)"` : `x="${+cx + dx[1]}" y="${+cy + (beside === 'below' && +cy + size + 16 <= base ? size + 12 : -size - 4)}" text-anchor="${dx[0]}"`} style="fill:${colour}" data-name>${text(names[k])}</text>` : '';
        const dot = !size ? '' : mark === 'ring' ? `<circle cx="${cx}" cy="${cy}" r="${size}" fill="var(--rx-paper)" stroke="${colour}" stroke-width="${size > 3 ? 1.6 : 1.2}"/>`
          : `<circle cx="${cx}" cy="${cy}" r="${size}" fill="${colour}" ${size > 3 ? 'stroke="var(--rx-paper)" stroke-width="2"' : ''}/>`;
        if (!said) return `<g pointer-events="none">${dot}${name}</g>`;
        const pressed = press[k] ? `role="button" tabindex="0" data-do="${action}" data-value="${text(press[k])}" aria-label="${text(said)}"` : '';
        const bars = scatter[k] ? `<path d="M${cx} ${Y(y[k] + scatter[k]).toFixed(1)}V${Y(y[k] - scatter[k]).toFixed(1)}" stroke="${colour}" stroke-width="${size / 2}" opacity=".55"/>` : '';
        return `<g ${mark === 'ring' ? 'data-mark' : ''} ${pressed} ${faint[k] ? 'opacity=".5"' : ''}><title>${text(said)}</title>${press[k] ? `<circle cx="${cx}" cy="${cy}" r="7" fill="transparent"/>` : ''}${bars}${dot}${name}</g>`;
      }).join('');
    },
  };
  // A line at a value, or an area where there is nothing to draw, and why.
  function rule({at, to = null, along, label, colour, dashes = ''}, {X, Y, left, right, top, base}) {
    if (to !== null) return `<rect x="${X(at).toFixed(1)}" y="${top}" width="${(X(to) - X(at)).toFixed(1)}" height="${base - top}" fill="var(--rx-field)" data-gap/>
      <text x="${X((at + to) / 2).toFixed(1)}" y="${((top + base) / 2 + 4).toFixed(1)}" text-anchor="middle">${text(label)}</text>`;
    const path = along === 'x' ? `M${X(at).toFixed(1)} ${top}V${base}` : `M${left} ${Y(at).toFixed(1)}H${right}`;
    const name = label && along === 'x' ? `<text transform="translate(${(X(at) - 4).toFixed(1)} ${base - 3}) rotate(-90)" style="fill:${colour}" data-name>${text(label)}</text>` : '';
    return `<path d="${path}" stroke="${colour}" stroke-width="1.2" stroke-dasharray="${dashes}"/>${name}`;
  }
  let clips = 0;
  // Everything within the axes; dots that lie beyond them stand at their edge.
  function inside(one, place) {
    const {left, right, top, base} = place, clip = `rxc${clips++ % 256}`, dots = one.series.filter(s => s.kind === 'points' && s.mark !== 'ring'), others = one.series.filter(s => !dots.includes(s));
    const drawn = others.map(s => DRAWN[s.kind](s, place)).join('');
    return `<clipPath id="${clip}"><rect x="${left}" y="${top - 1}" width="${right - left + 2}" height="${base - top + 2}"/></clipPath>
      ${(one.rules ?? []).map(r => rule(r, place)).join('')}<g clip-path="url(#${clip})">${drawn}</g>${dots.map(s => DRAWN.points(s, {...place, low: top, high: base})).join('')}`;
  }
  const swatch = ({kind, colour, dashes, mark}) => `<i style="${kind === 'points' ? `width:8px;height:8px;border-radius:50%;${mark === 'ring' ? `border:1.5px solid ${colour}` : `background:${colour}`}` : `border-top:${kind === 'band' ? 8 : 3}px ${dashes ? 'dashed' : 'solid'} ${colour};${kind === 'band' ? 'opacity:.3' : ''}`}"></i>`;
  const low = words => text(words).replace(/\b([CU])_(\w)/g, '$1<sub>$2</sub>');
  // A whole chart into an element: heading with the key of its lines, and the drawing with what the pointer reads on it.
  function fill(element, one, {height, width = element.clientWidth} = {}) {
    const high = height + (long(one) && !ends(one) ? 17 : 0), place = frame(one, width, high, long(one) && !ends(one) ? {bottom: 34} : {});
    const key = one.series.filter(s => s.label).map(s => `<span class="rxf-legend-line">${swatch(s)}${text(s.label)}</span>`).join('');
    const focus = element.contains(document.activeElement) && document.activeElement.dataset.value;
    if (one.note) element.title = one.note; else element.removeAttribute('title');
    element.innerHTML = `<div class="rxf-head"><b>${low(one.title)}</b><span class="rxf-dim">${low(one.y.label)}</span>${key}<span class="rxf-num ${one.kind ? `rxf-${one.kind}` : ''}" data-value>${text(one.value)}</span></div>
      <svg viewBox="0 0 ${width} ${high}" role="img" aria-label="${text(`${one.title}, ${one.y.label ?? ''}. ${one.value ?? ''} ${one.note ?? ''}`)}">${axes(one, place)}${inside(one, place)}<path data-hair pointer-events="none"/></svg>`;
    element.drawn = {one, place};
    if (focus) element.querySelector(`[data-do][data-value="${CSS.escape(focus)}"]`)?.focus({preventScroll: true});
  }
  // A point with a press is a button, by keys as by the pointer.
  document.addEventListener('keydown', event => {
    const point = event.target instanceof Element && event.target.closest('svg [role=button][data-do]');
    if (!point || (event.key !== 'Enter' && event.key !== ' ')) return;
    event.preventDefault();
    event.stopPropagation();
    point.dispatchEvent(new MouseEvent('click', {bubbles: true}));
  }, true);
  // The pointer over a chart: a hair, and the values of its lines there in place of its number.
  let read = null;
  function rest() {
    if (!read) return;
    const value = read.querySelector('[data-value]');
    if (value) { value.textContent = read.drawn.one.value ?? ''; value.style.color = ''; }
    read.querySelector('[data-hair]')?.removeAttribute('d');
    read = null;
  }
  addEventListener('pointermove', event => {
    const svg = event.buttons ? null : event.target instanceof Element && event.target.closest('svg'), element = svg && svg.parentElement;
    if (!element?.drawn || !svg.querySelector('[data-hair]')) { rest(); return; }
    if (read !== element) rest();
    const {one, place} = element.drawn, box = svg.getBoundingClientRect(), x = (event.clientX - box.left) * place.width / box.width;
    const lines = one.series.filter(s => s.kind === 'line' && s.x.length > 2);
    if (x < place.left || x > place.right || !lines.length) { rest(); return; }
    read = element;
    const near = lines.at(-1).x.reduce((best, v) => Math.abs(place.X(v) - x) < Math.abs(place.X(best) - x) ? v : best);
    const values = lines.map(s => [s, s.y[s.x.indexOf(near)]]).filter(([, y]) => y !== undefined && y !== null);
    const name = long(one) ? '' : one.x.label ?? '';
    svg.querySelector('[data-hair]').setAttribute('d', `M${place.X(near).toFixed(1)} ${place.top}V${place.base}`);
    const value = element.querySelector('[data-value]');
    value.innerHTML = `${text(name)} ${digits(near)}: ${values.map(([s, y]) => `<span style="color:${s.colour}">${digits(y)}</span>`).join(' ')}`;
  }, {passive: true});
  addEventListener('pointerout', event => { if (!event.relatedTarget) rest(); });

  // Charts that stand in text of the server: their value is an attribute. They are drawn where they come into view.
  const resized = new ResizeObserver(all => { for (const {target} of all) paint(target); });
  function paint(place) {
    const {chart, high} = place.dataset, width = place.clientWidth;
    if (!width || place.stamp === chart + width) return;
    place.stamp = chart + width;
    fill(place, JSON.parse(chart), {height: Number(high)});
  }
  function find(root = document) {
    for (const place of root.querySelectorAll('[data-chart]')) {
      if (!place.stamp) resized.observe(place);
      paint(place);
    }
  }
  return {text, clamp, fixed, signed, bar, frame, rows, axes, inside, fill, find};
})();
