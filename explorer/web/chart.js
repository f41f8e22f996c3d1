// @ts-check
// The charts of the page: one drawing of what `rotor.support.chart` says as JSON.
// Ticks, ends of the
// axes and colours come with it.
const Charts = (() => {
  const {text, clamp, lerp, distance, trace, closest} = Common;
  const digits = value => (value < 0 ? '−' : '')
    + Math.abs(value).toLocaleString('en', {maximumFractionDigits: Math.abs(value) < 10 ? 3 : 1, useGrouping: false});
  // Numbers between the ends of an axis wait, where there are many charts, for the pointer: `data-between`.
  const between = (k, ticks) => k > 0 && k < ticks.length - 1 ? ' data-between' : '';
  // A colour bar with its ticks; the triangles at its ends are for values beyond it.
  const bar = (colours, ticks, beyond = [true, true]) => {
    const triangle = end =>
      `<i style="background:${colours.at(-end)};visibility:${beyond[end] ? 'visible' : 'hidden'}"></i>`;
    const words = ticks.map(([at, word], k) =>
      `<span style="left:${at}%" ${between(k, ticks)}>${text(word)}</span>`);
    return `<div class="rxf-grad">${triangle(0)}
      <i style="background:linear-gradient(90deg,${colours.join()})"></i>${triangle(1)}</div>
      <div class="rxf-ticks rxf-num">${words.join('')}</div>`;
  };

  // Where values lie in a drawing, and the values of a place.
  function frame(chart, width, height, {left = 0, right = 8, top = 8, bottom = 17} = {}) {
    left ||= 12 + 7 * Math.max(3, ...chart.y.ticks.map(([, word]) => word.length));
    const base = height - bottom, axis = ({range: [low, high], log}, from, to) => ({
      to: value => {
        const share = ((log ? Math.log10(Math.max(value, 1e-300)) : value) - low) / (high - low);
        return clamp(from + share * (to - from), -1e6, 1e6);
      },
      back: pixel => {
        const value = low + (pixel - from) / (to - from) * (high - low);
        return log ? 10 ** value : value;
      },
    });
    const x = axis(chart.x, left, width - right), y = axis(chart.y, base, top);
    return {X: x.to, Y: y.to, atX: x.back, atY: y.back, left, right: width - right, top, base, width, height};
  }
  // In a low chart the words of inner rows are left out where they would touch.
  const LINE = 12;  // [px]
  function rows({y: {ticks}}, {Y, left, right}) {
    const tight = ticks.length > 2 && Math.abs(Y(ticks[1][0]) - Y(ticks[0][0])) < LINE;
    return ticks.map(([value, word], k) => {
      const told = tight && k > 0 && k < ticks.length - 1 ? '' : text(word);
      return `
    <path d="M${left} ${Y(value).toFixed(1)}H${right}" stroke="var(${value === 0 ? '--rx-faint' : '--rx-grid'})"/>
    <text x="${left - 6}" y="${(Y(value) + 4).toFixed(1)}" text-anchor="end"${between(k, ticks)}>${told}</text>`;
    }).join('');
  }
  // A short name stands left of the first number, a long one in the middle below, between ends if only these are told.
  const long = ({x}) => (x.label ?? '').length > 5, lower = chart => long(chart) && !chart.x.ends;
  function axes(chart, place) {
    const {X, left, right, base} = place, {ticks, ends, label} = chart.x, last = ticks.length - 1, low = base + 15;
    const columns = ticks.map(([value, word], k) => {
      const waits = label === 'ψ' ? '' : between(k, ticks);  // Quarters of a turn are always told.
      const wide = k === last && X(value) + 3.5 * word.length > right + 8, x = wide ? right + 8 : X(value);
      const anchor = ends && !k ? 'start' : wide || (k === last && ends) ? 'end' : 'middle';
      return `<text x="${x.toFixed(1)}" y="${low}" text-anchor="${anchor}"${waits}>${text(word)}</text>`;
    });
    const [x, y, anchor] = long(chart) ? [(left + right) / 2, low + (ends ? 0 : 15), 'middle'] : [left - 9, low, 'end'];
    return `${rows(chart, place)}${columns.join('')}
      <text x="${x}" y="${y}" text-anchor="${anchor}" data-axis>${text(label)}</text>`;
  }
  // Where the name of a point or of a rule stands: it meets no mark and no other name, and crosses the lines least;
  // empty where there is no such place, and it waits for the pointer. Letters are as wide as they usually are: to ask
  // for their true width costs a layout with every answer. `taken`: boxes of all else there, left, top, right, bottom.
  const LETTER = 6.9, HIGH = 9, DEEP = 3;  // [px]
  const FLAT = size => [
    ['middle', 0, -size - 4], ['middle', 0, size + 12], ['start', size + 4, 4], ['end', -size - 4, 4],
    ['start', -size, -size - 4], ['end', size, -size - 4], ['start', -size, size + 12], ['end', size, size + 12],
  ];
  const PLACES = {
    above: FLAT, below: size => [FLAT(size)[1], ...FLAT(size)],
    rule: (_, wide, high) => [-3, wide + 4 - high].flatMap(dy => [['up', -4, dy], ['up', 12, dy]]),
  };
  function placer({series, rules = []}, {X, Y, left, right, top, base}, taken) {
    const crossed = [];
    for (const {kind, x, y, size = 4} of series.filter(one => one.kind !== 'band')) {
      let last = null;
      x.forEach((at, k) => {
        const here = y[k] === null ? null : [X(at), clamp(Y(y[k]), top, base)];
        if (here && kind === 'points' && size)
          taken.push([here[0] - size - 1, here[1] - size - 1, here[0] + size + 1, here[1] + size + 1]);
        const many = here && last && kind === 'line' ? Math.ceil(distance(here, last) / 4) : 0;
        for (let step = 0; step < many; step++)
          crossed.push(here?.map((value, i) => lerp(value, last[i], step / many)));
        last = here;
      });
    }
    for (const {at, along} of rules) if (along === 'x') for (let y = top; y < base; y += 4) crossed.push([X(at), y]);
    return (word, cx, cy, size, where = 'above') => {
      const wide = LETTER * word.length, room = [left, Math.min(top - 8, 0), right + 8, base + 1];
      const free = PLACES[where](size, wide, base - top).map(([anchor, dx, dy]) => {
        const x = cx + dx, y = cy + dy, from = x - {start: 0, middle: wide / 2, end: wide, up: HIGH}[anchor];
        const box = anchor === 'up' ? [from, y - wide, x + DEEP, y] : [from, y - HIGH, from + wide, y + DEEP];
        return {anchor, x: x.toFixed(1), y: y.toFixed(1), box};
      }).filter(({box: [a, b, c, d]}) => a >= room[0] && b >= room[1] && c <= room[2] && d <= room[3]
        && !taken.some(other => a < other[2] && other[0] < c && b < other[3] && other[1] < d));
      const cost = ({box: [a, b, c, d]}) => crossed.filter(([x, y]) => a < x && x < c && b < y && y < d).length;
      const [best] = free.map(one => ({...one, cost: cost(one)})).sort((one, other) => one.cost - other.cost);
      if (!best) return '';
      taken.push(best.box);
      const {anchor, x, y} = best;
      return anchor === 'up' ? `transform="translate(${x} ${y}) rotate(-90)"`
        : `x="${x}" y="${y}" text-anchor="${anchor}"`;
    };
  }
  const DRAWN = {
    line({x, y, colour, width = 2, dashes, dots, filled}, place) {
      const {X, Y} = place;
      const known = x.map((at, k) => [X(at), y[k] === null ? null : Y(y[k])]);
      const pieces = [/** @type {any[]} */ ([])];  // A line has gaps where it has no values.
      for (const point of known) {
        if (point[1] === null) pieces.push([]);
        else pieces[pieces.length - 1].push(point);
      }
      const path = pieces.filter(piece => piece.length).map(trace).join('');
      if (!path) return '';
      const all = pieces.flat(), foot = trace([all.at(-1), all[0]].map(([at]) => [at, Y(0)])).replace('M', 'L');
      return `${filled ? `<path d="${path}${foot}Z" fill="${colour}" opacity=".1"/>` : ''}
        <path d="${path}" fill="none" stroke="${colour}" stroke-width="${width}" stroke-linejoin="round"
          ${dashes ? `stroke-dasharray="${dashes}"` : ''}/>
        ${dots ? DRAWN.points({x, y, colour, size: 3}, place) : ''}`;
    },
    band({x, low, high, colour, opacity = .17}, {X, Y}) {
      const known = x.map((_, k) => k).filter(k => low[k] !== null && high[k] !== null);
      const edge = values => known.map(k => [X(x[k]), Y(values[k])]);
      const path = known.length && `${trace([...edge(low), ...edge(high).reverse()])}Z`;
      return path ? `<path d="${path}" fill="${colour}" opacity="${opacity}" data-band/>` : '';
    },
    points(series, {X, Y, low = undefined, high = undefined, settle}) {
      const {x, y, colour, mark = 'dot', size = 4, name_place: side, action} = series, ring = mark === 'ring';
      const {words = [], press = [], names = [], faint = [], scatter = []} = series;
      return x.map((at, k) => {
        if (y[k] === null) return '';
        const height = low === undefined || ring ? Y(y[k]) : clamp(Y(y[k]), low, high);
        const cx = +X(at).toFixed(1), cy = +height.toFixed(1);
        const stands = names[k] && settle(names[k], cx, cy, size, side);
        const name = stands ? `<text ${stands} style="fill:${colour}" data-name>${text(names[k])}</text>` : '';
        const style = ring ? `fill="var(--rx-paper)" stroke="${colour}" stroke-width="${size > 3 ? 1.6 : 1.2}"`
          : `fill="${colour}" ${size > 3 ? 'stroke="var(--rx-paper)" stroke-width="2"' : ''}`;
        const dot = size ? `<circle cx="${cx}" cy="${cy}" r="${size}" ${style}/>` : '';
        if (!words[k]) return `<g pointer-events="none">${dot}${name}</g>`;
        const said = text(words[k]);
        const button = press[k] ? `role="button" tabindex="0" data-do="${action}" data-value="${text(press[k])}"
          aria-label="${said}"` : '';
        const [top, foot] = [1, -1].map(sign => Y(y[k] + sign * scatter[k]).toFixed(1));
        const bars = scatter[k] ? `<path d="M${cx} ${top}V${foot}" stroke="${colour}" stroke-width="${size / 2}"
          opacity=".55"/>` : '';
        return `<g ${ring ? 'data-mark' : ''} ${button} ${faint[k] ? 'opacity=".5"' : ''}><title>${said}</title>
          ${press[k] ? `<circle cx="${cx}" cy="${cy}" r="7" fill="transparent"/>` : ''}${bars}${dot}${name}</g>`;
      }).join('');
    },
  };
  // A line at a value, or an area where there is nothing to draw, and why.
  function rule({at, to = null, along, label, colour, dashes = ''}, {X, Y, left, right, top, base, settle}) {
    if (to !== null) return [`
      <rect x="${X(at)}" y="${top}" width="${X(to) - X(at)}" height="${base - top}" fill="var(--rx-field)" data-gap/>
      <text x="${X((at + Number(to)) / 2)}" y="${(top + base) / 2 + 4}" text-anchor="middle">${text(label)}</text>`];
    const path = along === 'x' ? `M${X(at).toFixed(1)} ${top}V${base}` : `M${left} ${Y(at).toFixed(1)}H${right}`;
    const stands = label && along === 'x' && settle(label, X(at), base, 0, 'rule');
    const name = stands ? `<text ${stands} style="fill:${colour}" data-name>${text(label)}</text>` : '';
    return [`<path d="${path}" stroke="${colour}" stroke-width="1.2" stroke-dasharray="${dashes}"/>`, name];
  }
  let clips = 0;
  // Everything within the axes; dots that lie beyond them stand at their edge.
  function inside(chart, room, taken = []) {
    const {series, rules = []} = chart, {left, right, top, base} = room, clip = `rxc${clips++ % 256}`;
    const place = {...room, settle: placer(chart, room, taken)};
    const ruled = rules.map(one => rule(one, place));
    // A scale with a wider one beside it leaves to that what lies beyond.
    const dots = series.filter(({kind, mark}) => kind === 'points' && mark !== 'ring' && !chart.y.whole);
    const drawn = series.filter(one => !dots.includes(one)).map(one => DRAWN[one.kind](one, place));
    return `<clipPath id="${clip}">
        <rect x="${left}" y="${top - 1}" width="${right - left + 2}" height="${base - top + 2}"/></clipPath>
      ${ruled.map(([line]) => line).join('')}<g clip-path="url(#${clip})">${drawn.join('')}</g>
      ${ruled.map(([, name]) => name ?? '').join('')}
      ${dots.map(one => DRAWN.points(one, {...place, low: top, high: base})).join('')}`;
  }
  function swatch({kind, colour, dashes, mark}) {
    const style = mark === 'ring' ? 'border:1.5px solid' : 'background:';
    const dot = `width:8px;height:8px;border-radius:50%;${style} ${colour}`;
    const band = kind === 'band', line = `border-top:${band ? 8 : 3}px ${dashes ? 'dashed' : 'solid'} ${colour}`;
    return `<i style="${kind === 'points' ? dot : line}${band ? ';opacity:.3' : ''}"></i>`;
  }
  const subscripts = words => text(words).replace(/\b([CU])_(\w)/g, '$1<sub>$2</sub>');
  // A whole chart into an element: heading with the key of its lines, and the drawing with what the pointer reads.
  // `scale`: a control before its value.
  function fill(element, chart, {height, width = element.clientWidth, scale = ''}) {
    const {title, value, kind, note, y} = chart, high = height + (lower(chart) ? 17 : 0);
    const place = frame(chart, width, high, lower(chart) ? {bottom: 34} : {});
    const key = chart.series.filter(({label}) => label)
      .map(one => `<span class="rxf-legend-line">${swatch(one)}${text(one.label)}</span>`).join('');
    const active = /** @type {any} */ (document.activeElement);
    const {value: focus = '', page = ''} = element.contains(active) ? active.dataset : {};
    const spoken = text(`${title}, ${y.label ?? ''}. ${value ?? ''} ${note ?? ''}`);
    if (note) element.title = note; else element.removeAttribute('title');
    element.innerHTML = `
      <div class="rxf-head"><b>${subscripts(title)}</b><span class="rxf-dim">${subscripts(y.label)}</span>${key}${scale}
        <span class="rxf-num ${kind ? `rxf-${kind}` : ''}" data-value>${text(value)}</span></div>
      <svg viewBox="0 0 ${width} ${high}" role="img" aria-label="${spoken}">
        ${axes(chart, place)}${inside(chart, place)}<path data-turn pointer-events="none"/>
        <path data-hair pointer-events="none"/></svg>`;
    element.drawn = {chart, place};
    markTurn(element);
    const again = page ? '[data-page]' : focus && `[data-do][data-value="${CSS.escape(focus)}"]`;
    if (again) element.querySelector(again)?.focus({preventScroll: true});
  }
  // A folded chart: its name, its value, and its lines without axes.
  function spark(element, chart) {
    const {title, value, kind} = chart;
    element.innerHTML = `<div class="rxf-head"><b>${subscripts(title)}</b>
        <span class="rxf-num ${kind ? `rxf-${kind}` : ''}" data-value>${text(value)}</span></div><svg></svg>`;
    const svg = element.querySelector('svg'), {clientWidth: width, clientHeight: height} = svg;
    if (width < 20) return;
    const place = frame(chart, width, height, {left: 2, right: 4, top: 3, bottom: 3});
    const drawn = chart.series.filter(one => one.kind !== 'points').map(one => DRAWN[one.kind](one, place));
    const now = chart.speeds && chart.series.at(-1).y[0];
    const dot = now === null || now === undefined ? ''
      : `<circle cx="${place.X(chart.speeds.mu)}" cy="${place.Y(now)}" r="3.5" fill="var(--rx-blade)"/>`;
    svg.setAttribute('viewBox', `0 0 ${width} ${height}`);
    svg.innerHTML = drawn.join('') + dot;
    element.drawn = null;
  }
  // A line on every chart along the blade or around a turn, at the place of each such axis; null: on none.
  let marked = null;
  function turn(places) {
    marked = places;
    for (const element of document.querySelectorAll('.rxf-chart')) markTurn(element);
  }
  function markTurn(element) {
    const {chart, place} = element.drawn ?? {}, at = marked?.[chart?.x.label];
    const x = at === undefined ? '' : place.X(at).toFixed(1), mark = element.querySelector('[data-turn]');
    mark?.setAttribute('d', x && `M${x} ${place.top}V${place.base}`);
  }
  // A point with a press is a button, by keys as by the pointer.
  document.addEventListener('keydown', event => {
    const point = closest(event, 'svg [role=button][data-do]');
    if (!point || (event.key !== 'Enter' && event.key !== ' ')) return;
    event.preventDefault();
    event.stopPropagation();
    point.dispatchEvent(new MouseEvent('click', {bubbles: true}));
  }, true);
  // The pointer over a chart: a hair, and the values of its lines there in place of its number.
  let read = null;
  function rest() {
    const value = read?.querySelector('[data-value]');
    if (value && read.drawn) value.textContent = read.drawn.chart.value ?? '';
    read?.querySelector('[data-hair]')?.removeAttribute('d');
    read = null;
  }
  addEventListener('pointermove', event => {
    const svg = event.buttons ? null : closest(event, 'svg'), element = svg?.parentElement;
    if (read !== element) rest();
    if (!element?.drawn || !svg.querySelector('[data-hair]')) return rest();
    const {chart, place} = element.drawn, box = svg.getBoundingClientRect();
    const x = (event.clientX - box.left) * place.width / box.width;
    const lines = chart.series.filter(one => one.kind === 'line' && one.x.length > 2);
    if (x < place.left || x > place.right || !lines.length) return rest();
    read = element;
    const away = value => Math.abs(place.X(value) - x);
    const nearest = lines.at(-1).x.reduce((best, value) => away(value) < away(best) ? value : best);
    const values = lines.map(one => [one.colour, one.y[one.x.indexOf(nearest)]])
      .filter(([, value]) => value !== undefined && value !== null)
      .map(([colour, value]) => `<span style="color:${colour}">${digits(value)}</span>`);
    svg.querySelector('[data-hair]').setAttribute('d', `M${place.X(nearest).toFixed(1)} ${place.top}V${place.base}`);
    element.querySelector('[data-value]').innerHTML =
      `${long(chart) ? '' : text(chart.x.label)} ${digits(nearest)}: ${values.join(' ')}`;
  }, {passive: true});
  addEventListener('pointerout', event => { if (!event.relatedTarget) rest(); });

  // Charts that stand in text of the server: their value is an attribute. They are drawn where they come into view.
  const resized = new ResizeObserver(all => { for (const {target} of all) paint(target); });
  function paint(element) {
    const {chart, high} = element.dataset, width = element.clientWidth;
    if (!width || element.stamp === chart + width) return;
    element.stamp = chart + width;
    fill(element, JSON.parse(chart), {height: Number(high)});
  }
  function find(root = document) {
    for (const element of root.querySelectorAll('[data-chart]')) {
      if (!element.stamp) resized.observe(element);
      paint(element);
    }
  }
  return {bar, frame, rows, axes, inside, fill, spark, find, turn};
})();
