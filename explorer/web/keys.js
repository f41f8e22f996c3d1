// @ts-check
// Keys in addition to viser's: coarse steps of sliders, and who gets a key.
(() => {
  const arrows = new Set(['ArrowUp', 'ArrowDown', 'ArrowLeft', 'ArrowRight']);
  const pages = {PageUp: 'ArrowUp', PageDown: 'ArrowDown'};
  const {closest: on} = Common;

  // Shift and an arrow, Page up, Page down: so many single steps, each after the page has taken the one before.
  window.addEventListener('keydown', async event => {
    if (!event.isTrusted || event.ctrlKey || event.metaKey || event.altKey) return;
    const key = pages[event.key] ?? (event.shiftKey && arrows.has(event.key) ? event.key : null);
    const field = on(event, 'input[inputmode=decimal], input[inputmode=numeric]');
    // The dial's dot has coarse steps of its own: each step draws it anew, so a second event would not reach it.
    if (!key || !(on(event, '[role=slider]:not([data-dot])') || field)) return;
    if (field && (key === 'ArrowLeft' || key === 'ArrowRight')) return;  // There they select text.
    event.preventDefault();
    event.stopPropagation();
    for (let step = 0; step < RX.state.coarse; step++) {
      event.target?.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true, cancelable: true}));
      event.target?.dispatchEvent(new KeyboardEvent('keyup', {key, bubbles: true}));
      await new Promise(done => setTimeout(done));
    }
  }, true);

  // A key that a widget uses is the widget's alone; this is reached after the widget and before the page's own keys.
  document.body.addEventListener('keydown', event => {
    const widget = '[role=slider], [role=tab], [role=option], [role=listbox], [role=menu], [role=separator], input';
    const moves = arrows.has(event.key) || event.key in pages;
    const presses = event.key === ' ' || event.key === 'Enter';
    const pressed = 'button:not([role=tab]), a, summary, input';
    if ((moves && on(event, widget)) || (presses && on(event, pressed))) event.stopPropagation();
  });

  // Arrows step the probe; viser would turn the camera with them too. Commands listen here, its camera further out.
  document.documentElement.addEventListener('keydown', event => {
    if (arrows.has(event.key) || event.ctrlKey || event.metaKey) event.stopPropagation();
  });

  // A box that was clicked, or a field that was left with Escape, does not keep the keyboard to itself.
  window.addEventListener('click', event => {
    if (event.detail > 0 && on(event, 'input[type=checkbox], label')) setTimeout(() => {
      if (document.activeElement?.type === 'checkbox') document.activeElement.blur();
    });
  });
  window.addEventListener('keydown', event => {
    if (event.key === 'Escape') on(event, 'input')?.blur();
  });
})();
