// What covers what: pairs of cards, bars and panels whose boxes meet, what hangs out of the window, and controls that
// another element hides or the edge of a card cuts.
() => {
  const seen = element => element.checkVisibility({opacityProperty: true, visibilityProperty: true}) && !element.closest('.mantine-Notification-root, .rxf-said');
  const name = element => element.dataset?.explorer || element.dataset?.dockRegion || element.dataset?.region || element.dataset?.part || element.dataset?.value || element.dataset?.do || element.ariaLabel || String(element.getAttribute('class')).split(' ').at(-1);
  const all = selector => [...document.querySelectorAll(selector)].filter(seen).map(element => ({element, box: element.getBoundingClientRect()})).filter(({box}) => box.width > 1 && box.height > 1);
  const meet = (a, b, by = 2) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > by && Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > by;
  const surfaces = all('.rxf-bar, .rxf-line, #rx .rxf-card:not([data-reading], .rxf-sheet *), .rxf-sheet, .rxf-grip, .rxf-notice, .rxf-prompt, .rxf-label, .rxf-fly-bar > div > div, [data-dock-region]');
  const hit = [];
  surfaces.forEach((a, k) => surfaces.slice(k + 1).forEach(b => {
    if (!a.element.contains(b.element) && !b.element.contains(a.element) && meet(a.box, b.box)) hit.push(`${name(a.element)} × ${name(b.element)}`);
  }));
  const rim = document.documentElement.hasAttribute('data-plan') && document.querySelector('.rxf-plan svg circle');
  const disk = rim ? rim.getBoundingClientRect() : null;
  if (disk) {
    const [x, y, r] = [(disk.left + disk.right) / 2, (disk.top + disk.bottom) / 2, disk.width / 2];
    for (const {element, box} of surfaces) if (Math.hypot(Math.max(box.left - x, x - box.right, 0), Math.max(box.top - y, y - box.bottom, 0)) < r - 2) hit.push(`disk × ${name(element)}`);
  }
  const outside = surfaces.filter(({box}) => box.left < -1 || box.right > innerWidth + 1 || box.top < -1 || box.bottom > innerHeight + 1).map(({element}) => name(element));
  const controls = all('#rx :is(button, select, input, [role=button]), [data-dock-region] :is(button, input:not([type=hidden]), [role=slider])');
  const within = box => box.left + box.width / 2 > 0 && box.left + box.width / 2 < innerWidth && box.top + box.height / 2 > 0 && box.top + box.height / 2 < innerHeight;
  // The nearest thing that scrolls shows only a part of what it holds; the rest is a swipe away.
  const scrolled = ({element, box}) => {
    for (let above = element.parentElement; above; above = above.parentElement) {
      const over = getComputedStyle(above), edge = above.getBoundingClientRect();
      if (/auto|scroll/.test(over.overflowX + over.overflowY) && !(box.left >= edge.left - 1 && box.right <= edge.right + 1 && box.top >= edge.top - 1 && box.bottom <= edge.bottom + 1)) return true;
    }
    return false;
  };
  const shown = controls.filter(one => within(one.box) && !scrolled(one));
  const hidden = shown.filter(({element, box}) => {
    const top = document.elementFromPoint(box.left + box.width / 2, box.top + box.height / 2);
    return !element.disabled && top && !element.contains(top) && !top.contains(element) && !element.parentElement.contains(top);
  }).map(({element}) => name(element));
  // Less than 44 px high or wide under a finger, with what it catches around it. What a mark in a chart does, a slider does too;
  // of two words of the sentence the nearer one is meant.
  const worded = element => element.closest('.rxf-line') && element.closest('[data-handle], span[data-value=trust]');
  const narrow = shown.filter(({element, box}) => {
    const from = [box.left + box.width / 2, box.top + box.height / 2], ways = [[box.height, 0, 21], [box.width, 21, 0]];
    return !element.disabled && !element.matches('svg [data-do]') && ways.some(([size, dx, dy]) => size < 43.5 && [-1, 1].some(way => {
      const met = document.elementFromPoint(from[0] + way * dx, from[1] + way * dy);
      return met && !element.contains(met) && !met.contains(element) && !element.labels?.[0]?.contains(met)
        && !(worded(element) && worded(met));
    }));
  }).map(({element, box}) => `${name(element)} ${Math.round(box.width)}×${Math.round(box.height)}`);
  // The free band of the scene: between what stands over it above and below.
  const canvas = document.querySelector('canvas').getBoundingClientRect(), middle = (canvas.top + canvas.bottom) / 2;
  const over = all('#rx :is(.rxf-bar, .rxf-power, .rxf-views, .rxf-notice, .rxf-grip, .rxf-sheet, .rxs-column, .rxf-card), [data-dock-region]')
    .filter(({element, box}) => !element.closest('.rxf-plan') && meet(box, canvas)).map(({box}) => box);
  const free = {
    left: canvas.left, right: canvas.right,
    top: Math.max(canvas.top, ...over.map(box => (box.top + box.bottom) / 2 < middle ? box.bottom : 0)),
    bottom: Math.min(canvas.bottom, ...over.map(box => (box.top + box.bottom) / 2 < middle ? innerHeight : box.top)),
  };
  const nameless = all('.rxf-bar button').filter(({element}) => !element.innerText.trim()).map(({element}) => name(element));
  const words = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT), cut = [];
  while (words.nextNode()) {
    const node = words.currentNode, element = node.parentElement;
    if (!node.textContent.trim() || element.closest('script, style, noscript, option, title, .mantine-Notification-root') || !seen(element)) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    const box = range.getBoundingClientRect();
    if (!box.width || !within(box) || scrolled({element, box})) continue;
    for (let above = element; above && above !== document.body; above = above.parentElement) {
      const edge = above.getBoundingClientRect();
      if (above.matches('.rxf-card, .rxf-menu') && box.right > edge.right + 2) cut.push(`${node.textContent.trim().slice(0, 30)} in ${name(above)}`);
    }
  }
  return {hit, outside, hidden, nameless, cut, narrow, free, disk: disk && Math.round(disk.width)};
}
