// Text below 12 px but for indices, text with less contrast than AA asks for, and how far the page is wider than its window.
() => {
  const small = [], faint = [], light = v => (v /= 255) <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4;
  const rgba = css => { const v = css.match(/[\d.]+/g).map(Number), k = css.startsWith('color(') ? 255 : 1; return [k * v[0], k * v[1], k * v[2], v[3] ?? 1]; };
  const over = (a, b) => [0, 1, 2].map(k => a[k] * a[3] + b[k] * (1 - a[3])).concat(1);
  const luminance = c => 0.2126 * light(c[0]) + 0.7152 * light(c[1]) + 0.0722 * light(c[2]);
  // The colour behind an element; null over a picture, a gradient or the canvas.
  const ground = (element, svg) => {
    const layers = [];
    for (let node = svg ?? element; node; node = node.parentElement) {
      const style = getComputedStyle(node), colour = rgba(style.backgroundColor);
      if (style.backgroundImage !== 'none') return null;
      if (colour[3]) layers.unshift(colour);
      if (colour[3] === 1) return layers.reduce((below, above) => over(above, below));
    }
    return null;
  };
  const all = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  while (all.nextNode()) {
    const words = all.currentNode.textContent.trim(), element = all.currentNode.parentElement;
    if (!words || element.closest('script, style, noscript, title, desc, option, sub, tspan[dy], .mantine-Notification-root')) continue;
    const box = element.getBoundingClientRect();
    if (!box.width || !box.height || !element.checkVisibility({opacityProperty: true, visibilityProperty: true})) continue;
    const style = getComputedStyle(element), svg = element.ownerSVGElement, turned = svg && element.getScreenCTM();
    const size = parseFloat(style.fontSize) * (turned ? Math.hypot(turned.a, turned.b) : 1);
    if (size < 11.95) small.push(`${words} (${size.toFixed(1)} px)`);
    const behind = ground(element, svg);
    if (!behind || element.closest(':disabled, [data-disabled]')) continue;
    let opacity = 1;
    for (let node = element; node; node = node.parentElement) opacity *= getComputedStyle(node).opacity;
    const ink = rgba(svg && /^(rgb|color)/.test(style.fill) ? style.fill : style.color);
    const both = [over([ink[0], ink[1], ink[2], ink[3] * opacity], behind), behind].map(luminance).sort((a, b) => b - a);
    const contrast = (both[0] + 0.05) / (both[1] + 0.05), large = size >= 24 || (size >= 18.66 && +style.fontWeight >= 700);
    if (contrast < (large ? 3 : 4.5)) faint.push(`${words} (${contrast.toFixed(2)})`);
  }
  // What is typed or chosen is no text of the document.
  for (const field of document.querySelectorAll(':is(#rx, [data-dock-region]) :is(input, select)')) {
    const size = parseFloat(getComputedStyle(field).fontSize);
    if (field.checkVisibility() && size < 11.95) small.push(`${field.outerHTML} (${size.toFixed(1)} px)`);
  }
  return {small, faint, wide: document.scrollingElement.scrollWidth - innerWidth};
}
