// @ts-check
// What the server asks of the page by name, and the fields that clicks write to.
(() => {
  const {clamp, closest} = Common, KEPT = 'rx-kept', page = document.documentElement;
  const kept = () => JSON.parse(sessionStorage.getItem(KEPT) ?? '{}');
  const answer = (key, text) => localStorage.setItem(`viser-user:${key}`, text);  // Where the server reads it.
  let asked = false;

  // As if typed, into a text widget of viser's that hears of it.
  function type(label, text) {
    const input = label?.closest('[class*=Flex-root]').querySelector('input');
    if (!input) return;
    Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, 'value')?.set?.call(input, text);
    input.dispatchEvent(new Event('input', {bubbles: true}));
  }
  const labelOf = (within, field) => [...within.querySelectorAll('label')].find(label => label.textContent === field);

  // A click on `data-write="FIELD"` writes `data-value` into the nearest field of that name.
  document.addEventListener('click', event => {
    const control = closest(event, '[data-write]');
    if (!control) return;
    let within = control, label = null;
    while (within && !(label = labelOf(within, control.dataset.write))) within = within.parentElement;
    type(label, control.dataset.value);
  });

  // A click on the map of power tells its place, 0…1 from the left and from below.
  document.addEventListener('click', event => {
    const {left, bottom, width, height} = closest(event, '[data-map]')?.getBoundingClientRect() ?? {};
    if (!width) return;
    const across = (event.clientX - left) / width, up = (bottom - event.clientY) / height;
    RX.send('map_at', [clamp(across, 0, 1), clamp(up, 0, 1)]);
  });

  Object.assign(RX, {
    // What only the browser knows: whether it asks for dark pages, its address, and what it was given to keep. A page
    // that was open before, and whose server has come back, stays as it was.
    facts(key) {
      const wished = matchMedia('(prefers-color-scheme: dark)').matches
        || new URLSearchParams(location.search).has('darkMode');
      const dark = asked ? page.dataset.mantineColorScheme === 'dark' : wished;
      asked = true;
      const {drawn: scene} = rotorScene, stores = sessionStorage instanceof Storage;
      answer(key, JSON.stringify({dark, query: location.search, kept: kept(), scene, stores}));
    },
    // A text too long for the browser's store (some megabytes) is not kept, nor what stood there before.
    keep(name, text) {
      try { sessionStorage.setItem(KEPT, JSON.stringify({...kept(), [name]: text})); }
      catch { sessionStorage.removeItem(KEPT); }
    },
    // All places are taken: ask until one is free, then begin anew. Pages that were turned away together ask at other
    // times.
    awaitPlace() {
      setTimeout(async () => {
        if (!document.querySelector('[data-explorer=lobby]')) return;  // The server has come back, with a place.
        const reply = await fetch('place').catch(() => null);
        if (reply?.ok && (await reply.text()).trim() === 'free') location.reload();
        else RX.awaitPlace();
      }, 3000 + 4000 * Math.random());
    },
    address(query) { history.replaceState(null, '', location.pathname + query); },
    copy(text) { navigator.clipboard?.writeText(text).catch(() => {}); },
    copyLink(query) { RX.copy(location.origin + location.pathname + query); },
    // HTML over the page until Escape or a click beside it; a second time closes it.
    dialog(content) {
      const before = document.querySelector('dialog.rx-dialog');
      if (before) { before.close(); return; }
      const dialog = document.createElement('dialog');
      dialog.className = 'rx-dialog';
      dialog.innerHTML = content;
      dialog.addEventListener('close', () => dialog.remove());
      dialog.addEventListener('click', event => { if (event.target === dialog) dialog.close(); });
      document.body.append(dialog);
      dialog.showModal();
    },
  });
  // A hidden tab has nothing computed; each answer that still comes, as the first of a new session, is told so.
  const tellSeen = () => RX.send('seen', !document.hidden);
  document.addEventListener('visibilitychange', tellSeen);
  addEventListener('rx-answered', () => { if (document.hidden) tellSeen(); });
  RX.paint('big', big => page.toggleAttribute('data-big', big));
})();
