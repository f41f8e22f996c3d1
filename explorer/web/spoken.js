// @ts-check
// Names that screen readers speak, and keys, for what viser draws without them; focus that survives a repaint.
(() => {
  const {closest, soon, viewer} = Common;
  const FOLDER = '[data-dock-region] .mantine-Paper-root[data-with-border] > .mantine-Paper-root';
  const NAMED = 'input:not([type=hidden], [type=checkbox], [role=combobox])';
  const NAMELESS = `[data-dock-region] :is([role=slider], ${NAMED}, textarea):is(:not([aria-label]), [aria-label=""])`;

  // viser writes the label of a slider and of its number field into their row, and ties it to neither.
  function labelOf(control) {
    const rowAround = element => element.parentElement?.closest('[class*=Flex-root]');
    for (let row = rowAround(control); row; row = rowAround(row)) {
      const label = row.querySelector('label');
      if (!label) continue;
      const kind = control.matches('[role=slider]') ? '[role=slider]' : 'input:not([type=hidden]), textarea';
      const alike = [...row.querySelectorAll(kind)];
      return label.textContent.trim() + (alike.length > 1 ? ` ${alike.indexOf(control) + 1}` : '');
    }
    return control.labels?.length ? '' : control.placeholder?.trim() ?? '';
  }
  // What viser draws belongs to no part of the page else: its columns, and the scene with its cover.
  function place() {
    const parts = [...document.querySelectorAll('[data-dock-region]')].map(dock =>
      [dock, dock.dataset.dockRegion === 'right' ? 'Controls' : 'Drawer']);
    for (const [part, words] of [...parts, [viewer()?.canvas?.parentElement, 'Scene']])
      if (part && part.role !== 'region') [part.role, part.ariaLabel] = ['region', words];
    for (const cover of document.querySelectorAll('canvas[width="0"]')) cover.ariaHidden = 'true';
  }
  function name() {
    place();
    for (const control of document.querySelectorAll(NAMELESS)) {
      const words = labelOf(control);
      if (words) control.ariaLabel = words;
    }
    for (const head of document.querySelectorAll(FOLDER)) {
      head.role = 'button';
      head.tabIndex = 0;
      const open = String((head.parentElement?.offsetHeight ?? 0) > head.offsetHeight + 24);
      if (head.ariaExpanded !== open) head.ariaExpanded = open;
    }
  }

  // What is pressed by key like a button, without being one.
  document.addEventListener('keydown', event => {
    if (event.key !== 'Enter' && event.key !== ' ') return;
    const pressed = closest(event, '*');
    if (!pressed?.matches(`${FOLDER}, #rx [role=button]`)) return;
    event.preventDefault();
    event.stopPropagation();
    pressed.dispatchEvent(new MouseEvent('click', {bubbles: true}));  // Parts of a drawing have no click().
    setTimeout(name, 400);  // Once the folder has unfolded.
  }, true);

  // Parts are drawn anew as a whole: the focus goes to the same control of the new drawing. A drawer that is opened by
  // key takes the focus, and gives it back when it closes.
  let last = null, opener = null, wanted = '';
  const control = ({dataset}, within) => {
    const all = [...within.querySelectorAll(`[data-do="${dataset.do}"]`)];
    return all.find(one => one.dataset.value === dataset.value) ?? (all.length === 1 ? all[0] : null);
  };
  document.addEventListener('focusin', event => { last = event.target; });
  document.addEventListener('pointerdown', () => { last = null; }, true);
  document.addEventListener('click', event => {
    const button = closest(event, '[data-do=drawer]');
    if (button?.dataset.value && event.detail === 0) [opener, wanted] = [button, button.dataset.value];
  }, true);
  function refocus() {
    if (wanted) {
      const close = document.querySelector(`[data-explorer=drawer][data-name="${wanted}"] button`);
      if (close) { wanted = ''; close.focus(); return; }
    }
    if (document.activeElement !== document.body || !last || last.isConnected) return;
    const again = last.dataset?.do ? control(last, document) : null;
    if (again) again.focus();
    else if (opener && !RX.state.bar?.drawer) (opener.isConnected ? opener : control(opener, document))?.focus();
  }

  new MutationObserver(soon(() => { name(); refocus(); })).observe(document.body, {childList: true, subtree: true});
})();
