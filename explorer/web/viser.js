// What we change in viser 1.1.1's client, before it runs: each change has a test in tests/browser/test_viser_client.py.
(() => {
  // In a narrow window the client would leave its docks for a sheet of its own; ours are drawers by style sheet.
  const media = window.matchMedia.bind(window);
  window.matchMedia = query => media(/max-width:\s*36em/.test(query) ? 'not all' : query);

  // The client replaces the function that sends when its connection opens and when it ends: then we hear of it.
  let client;
  function watch(next) {
    let send = next.sendMessage;
    Object.defineProperty(next, 'sendMessage', {get: () => send, set: other => {
      send = other;
      window.dispatchEvent(new CustomEvent('rx-connection', {detail: !/not connected/.test(String(other))}));
    }});
  }
  Object.defineProperty(window, '__viserMutable', {configurable: true, get: () => client, set: next => {
    client = next;
    if (next) watch(next);
  }});

  // A chart that is drawn anew before it has taken its new size keeps the old one, without numbers along its axis: so
  // every drawing looks at the axes. The client lists its charts here.
  const uplots = new Proxy({}, {set(charts, name, entry) {
    const redraw = entry.chart.redraw;
    entry.chart.redraw = paths => redraw(paths, true);
    charts[name] = entry;
    return true;
  }});
  let lists;
  Object.defineProperty(window, '__viserTestpoints', {configurable: true, get: () => lists, set: next => {
    lists = next && Object.assign(next, {uplots});
  }});

  // A page that can be seen tries again, also where another window has the keyboard, as in front of a class.
  document.hasFocus = () => document.visibilityState === 'visible';
  document.addEventListener('visibilitychange', () => window.dispatchEvent(new Event('focus')));
})();
