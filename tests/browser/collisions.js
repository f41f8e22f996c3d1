// Words that meet words or marks, that something covers or that are cut: a list of sentences, one for each pair.
// No fixed places: ink is taken as the middle of a line's box, and 2 px are let pass.
() => {
  const seen = element => element.checkVisibility({opacityProperty: true, visibilityProperty: true})
    && !element.closest('script, style, noscript, option, title, .mantine-Notification-root, .rxf-said, #rx h1, [inert], .cm-editor');
  const SVG = 'http://www.w3.org/2000/svg', PANEL = '.rxf-label, .rxf-card, .rxf-bar, .rxf-grip, .rxf-strip, .rxf-notice, .rxf-prompt, .rxf-menu, .rxs-column, [data-dock-region], [data-part]';
  const name = element => { const of = element.closest(PANEL); return of ? of.dataset.explorer || of.dataset.part || of.dataset.dockRegion || String(of.getAttribute('class')).split(' ').at(-1) : element.tagName; };
  const alpha = colour => { const all = colour.match(/[\d.]+/g) ?? [0, 0, 0, 0]; return colour === 'none' || colour === 'transparent' ? 0 : Number(all[3] ?? 1); };
  const block = element => { while (element.namespaceURI === SVG ? element.tagName !== 'text' : getComputedStyle(element).display.startsWith('inline') && getComputedStyle(element).display !== 'inline-flex') element = element.parentElement; return element; };
  const found = new Set(), words = [], all = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT), range = document.createRange();
  const clear = document.createElement('style');
  clear.textContent = '* {pointer-events: auto !important}';
  document.head.append(clear);
  // What an element that hides its overflow shows of it; null where it can be scrolled there.
  const edges = (element, box) => {
    for (let above = element; above && above !== document.body; above = above.parentElement) {
      const {overflowX, overflowY, textOverflow, position} = getComputedStyle(above), edge = above.getBoundingClientRect();
      const out = [Math.max(edge.left - box.left, box.right - edge.right), Math.max(edge.top - box.top, box.bottom - edge.bottom)];
      const [wide, high] = out.map(by => by > 2);
      if ((/auto|scroll/.test(overflowX) && wide) || (/auto|scroll/.test(overflowY) && high)) return null;
      const hides = (/hidden|clip/.test(overflowX) && wide) || (/hidden|clip/.test(overflowY) && high);
      if (hides && !(textOverflow === 'ellipsis' && above.closest('[title]'))) return name(above);
      if (position === 'fixed') break;
    }
    return '';
  };
  while (all.nextNode()) {
    const node = all.currentNode, element = node.parentElement, said = node.textContent.trim().replace(/\s+/g, ' ');
    if (!said || !element || !seen(element)) continue;
    const style = getComputedStyle(element), drawn = element.namespaceURI === SVG;
    if (!alpha(drawn ? style.fill : style.color)) continue;
    range.selectNodeContents(node);
    const upright = drawn && Math.abs(element.getScreenCTM()?.b ?? 0) > .5;
    for (const line of range.getClientRects()) {
      if (line.width < 2 || line.height < 2) continue;
      const [dx, dy] = upright ? [.22 * line.width, 0] : [0, .22 * line.height];
      words.push({said: said.slice(0, 40), element, drawn, block: block(element), panel: element.closest(PANEL), halo: drawn && /stroke/.test(style.paintOrder),
        box: {left: line.left + dx, right: line.right - dx, top: line.top + dy, bottom: line.bottom - dy}});
    }
  }
  const gone = box => box.right < 1 || box.bottom < 1 || box.left > innerWidth - 1 || box.top > innerHeight - 1;
  const shown = words.filter(word => {
    const {said, element, box, panel} = word;
    if (panel && gone(panel.getBoundingClientRect())) return false;
    const cut = edges(element, box);
    if (cut === null) return false;
    if (cut) { found.add(`"${said}" is cut by ${cut}`); return false; }
    if (box.left < -2 || box.top < -2 || box.right > innerWidth + 2 || box.bottom > innerHeight + 2) found.add(`"${said}" (${name(element)}) is cut by the window`);
    const clip = word.drawn && element.closest('[clip-path]'), rect = clip && document.querySelector(clip.getAttribute('clip-path').slice(4, -1).replace(/"/g, ''))?.firstElementChild;
    if (rect) {
      const {x, y, width, height} = rect.getBBox(), at = clip.getScreenCTM();
      const low = [at.a * x + at.e, at.d * y + at.f], high = [at.a * (x + width) + at.e, at.d * (y + height) + at.f];
      if (box.left < low[0] - 2 || box.right > high[0] + 2 || box.top < low[1] - 2 || box.bottom > high[1] + 2) found.add(`"${said}" is cut by its axes`);
    }
    return !gone(box);
  });
  // Covered: something painted stands before it.
  const painted = element => {
    const style = getComputedStyle(element);
    if (!seen(element) || +style.opacity < .3) return false;
    if (element.namespaceURI === SVG && element.tagName !== 'svg') {
      if (['text', 'tspan', 'g', 'title'].includes(element.tagName)) return false;
      return alpha(style.fill) * style.fillOpacity > .5 || (alpha(style.stroke) > .5 && parseFloat(style.strokeWidth) >= 1.4);
    }
    return ['IMG', 'CANVAS', 'IMAGE'].includes(element.tagName) || alpha(style.backgroundColor) > .5 || style.backgroundImage !== 'none';
  };
  const covers = ({element, drawn, halo, box}) => {
    for (const share of [.08, .5, .92]) {
      const [x, y] = [box.left + share * (box.right - box.left), (box.top + box.bottom) / 2];
      for (const above of document.elementsFromPoint(x, y)) {
        if (above === element || above.contains(element) || element.contains(above)) break;
        if (painted(above)) return above;
      }
    }
    return null;
  };
  for (const word of shown) word.cover = covers(word);
  for (const {said, cover, panel, element} of shown) {
    if (!cover) continue;
    // A panel that lies wholly behind another is put away.
    const own = panel && !panel.matches('.rxf-label') && !panel.contains(cover) && shown.filter(other => other.panel === panel);
    if (own && own.every(other => other.cover)) continue;
    found.add(`"${said}" (${name(element)}) is covered by ${cover.namespaceURI === SVG ? `a mark, ${cover.tagName}` : name(cover)}`);
  }
  const open = shown.filter(word => !word.cover).sort((a, b) => a.box.top - b.box.top);
  open.forEach(({said, box, block: own, drawn}, k) => {
    for (const other of open.slice(k + 1)) {
      if (other.box.top >= box.bottom) break;
      if (own === other.block) continue;
      const [wide, high] = [Math.min(box.right, other.box.right) - Math.max(box.left, other.box.left), Math.min(box.bottom, other.box.bottom) - Math.max(box.top, other.box.top)];
      if (high > 1 && wide > (high > 4 ? -2 : 1)) found.add(`"${said}" × "${other.said}"`);
    }
  });
  // Marks: dots and handles, lines that are no grid. A word within a larger dot is its name, and a halo may lie on a line.
  // A handle that lies wholly behind a panel is not seen: the controls stay where they are while the held blade has the window.
  const behind = ({element, box}) => {
    const panel = covers({element, box})?.closest(PANEL), edge = panel?.getBoundingClientRect();
    return panel && !panel.matches('.rxf-label') && !panel.contains(element) && edge.left <= box.left && edge.right >= box.right && edge.top <= box.top && edge.bottom >= box.bottom;
  };
  const marks = [...document.querySelectorAll('svg circle, .mantine-Slider-thumb')].filter(seen).map(element => ({element, box: element.getBoundingClientRect(), style: getComputedStyle(element)}))
    .filter(({element, box, style}) => box.width > 3 && box.width < 40 && (element.namespaceURI !== SVG || alpha(style.fill) > .3 || alpha(style.stroke) > .3)).filter(mark => !behind(mark));
  for (const {element, box: dot} of marks) for (const {said, box, panel} of open) {
    const [wide, high] = [Math.min(box.right, dot.right) - Math.max(box.left, dot.left), Math.min(box.bottom, dot.bottom) - Math.max(box.top, dot.top)];
    const within = box.top >= dot.top - 1 && box.bottom <= dot.bottom + 1 && Math.abs(box.left + box.right - dot.left - dot.right) < 4;
    if (wide > 1.5 && high > 1.5 && !within && edges(element, dot) === '') found.add(`"${said}" (${panel ? name(panel) : ''}) × a dot`);
  }
  const hit = new Map();
  for (const path of document.querySelectorAll('#rx svg path, .rxs-column svg path, [data-dock-region] svg path')) {
    const style = getComputedStyle(path), edge = path.getBoundingClientRect();
    if (!seen(path) || path.closest('[viewBox="0 0 24 24"], [viewBox="0 0 20 11"]') || parseFloat(style.strokeWidth) < 1.2 || alpha(style.stroke) * style.strokeOpacity * style.opacity < .5) continue;
    const near = open.filter(({box, drawn, halo, element}) => drawn && !halo && element.ownerSVGElement === path.ownerSVGElement && box.left < edge.right && box.right > edge.left && box.top < edge.bottom + 1 && box.bottom > edge.top - 1);
    if (!near.length) continue;
    const at = path.getScreenCTM(), long = path.getTotalLength(), clipped = path.closest('[clip-path]')?.getAttribute('clip-path').slice(4, -1);
    const frame = clipped && document.querySelector(`${clipped} rect`);  // A curve beyond its axis is not seen.
    const [least, most] = frame ? [frame.y.baseVal.value, frame.y.baseVal.value + frame.height.baseVal.value] : [-Infinity, Infinity];
    for (let s = 0; s <= long; s += 2) {
      const {x, y} = path.getPointAtLength(s);
      if (y < least || y > most) continue;
      const [px, py] = [at.a * x + at.c * y + at.e, at.b * x + at.d * y + at.f];
      for (const word of near) if (px > word.box.left + 1 && px < word.box.right - 1 && py > word.box.top + 1 && py < word.box.bottom - 1) hit.set(word, path);
    }
  }
  for (const [{said, element}] of hit) found.add(`"${said}" (${name(element)}) × a line`);
  // Lines from labels to what they name.
  const ties = [...document.querySelectorAll('[data-tie]')].filter(seen).map(path => [path.getPointAtLength(0), path.getPointAtLength(path.getTotalLength())]);
  const side = (a, b, c) => Math.sign((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x));
  const parted = ([a, b], [c, d]) => side(a, b, c) !== side(a, b, d);
  ties.forEach((one, k) => ties.slice(k + 1).forEach(other => { if (parted(one, other) && parted(other, one)) found.add('two lines to labels cross'); }));
  clear.remove();
  for (const field of document.querySelectorAll(':is(#rx, [data-dock-region]) input:not([type=hidden], [type=range], [type=checkbox])'))
    if (seen(field) && field.clientWidth && field.scrollWidth > field.clientWidth + 1) found.add(`"${field.value}" is cut by its field`);
  return [...found].sort();
}
