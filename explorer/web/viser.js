// @ts-check
// What we change in viser 1.1.1's client, before it runs: each change has a test in tests/browser/test_viser_client.py
// or test_reconnect.py, and a proposal to its authors in docs/developers/upstream.
(() => {
  // Where the browser has no WebGL the client would end, and the page with it: it gets a context that draws nothing.
  const VERSION = 7938, SCISSOR_BOX = 3088, VIEWPORT = 2978, MANY = 4096;  // As WebGL numbers what is asked.
  const ASKED = {[VERSION]: 'WebGL 2.0', [SCISSOR_BOX]: [0, 0, 1, 1], [VIEWPORT]: [0, 0, 1, 1]};
  const ANSWERS = {
    isContextLost: true, getContextAttributes: {}, getSupportedExtensions: [], getShaderInfoLog: '',
    getProgramInfoLog: '', getShaderPrecisionFormat: {precision: 23, rangeMin: 127, rangeMax: 127},
  };
  const undrawn = canvas => new Proxy({
    canvas, getParameter: what => ASKED[what] ?? MANY, getExtension: name => /color_buffer/.test(name) ? {} : null,
  }, {
    get: (own, /** @type {string} */ name) => own[name] ?? window.WebGL2RenderingContext?.[name]
      ?? (() => name in ANSWERS ? ANSWERS[name] : name.startsWith('create') ? {} : 0),
  });
  const getContext = HTMLCanvasElement.prototype.getContext;
  HTMLCanvasElement.prototype.getContext = /** @type {any} */ (function (kind, ...rest) {
    return getContext.call(this, kind, ...rest) ?? (kind === 'webgl2' ? undrawn(this) : null);
  });
  addEventListener('webglcontextcreationerror', event => event.stopImmediatePropagation(), true);

  // Where the browser stores nothing for a page, as with cookies blocked, its stores last until it is loaded again.
  for (const name of ['localStorage', 'sessionStorage']) try {
    window[name].setItem('rx-asked', '');
    window[name].removeItem('rx-asked');
  } catch {
    const kept = new Map();
    Object.defineProperty(window, name, {value: {
      getItem: key => kept.get(key) ?? null, setItem: (key, value) => { kept.set(key, String(value)); },
      removeItem: key => { kept.delete(key); },
    }});
  }

  // WebKitGTK names the language C where LANG is C.UTF-8: Intl refuses that, and the client then shows no controls.
  try { Intl.getCanonicalLocales(navigator.languages.concat(navigator.language)); }
  catch {
    Object.defineProperties(navigator, {language: {value: 'en'}, languages: {value: Object.freeze(['en'])}});
  }

  // In a narrow window the client would leave its docks for a sheet of its own; ours are drawers by style sheet.
  const media = window.matchMedia.bind(window);
  window.matchMedia = query => media(/max-width:\s*36em/.test(query) ? 'not all' : query);

  // The client asks its worker every second to connect, which closes a socket that is still connecting, and after five
  // seconds the worker closes it anyway: over a slow network it never connects. So it asks again only when the last
  // attempt has ended, and an attempt may take PATIENCE.
  const PATIENCE = 30000;  // [ms]
  const patient = `const Own = WebSocket;
    self.WebSocket = class extends Own {
      constructor(...where) {
        super(...where);
        setTimeout(() => { if (this.readyState === Own.CONNECTING) super.close(); }, ${PATIENCE});
      }
      close(...why) { if (this.readyState !== Own.CONNECTING) super.close(...why); }
    };`;
  const replaceState = history.replaceState.bind(history);
  history.replaceState = (state, title, where) => { if (title !== 'Viser') replaceState(state, title, where); };
  const first = URL.createObjectURL(new Blob([patient], {type: 'text/javascript'}));
  window.Worker = class extends Worker {
    constructor(script, options) {
      // Imports run in their order.
      const imports = [first, String(script)].map(name => `import ${JSON.stringify(name)};`);
      const both = new Blob(imports, {type: 'text/javascript'});
      super(options?.type === 'module' ? URL.createObjectURL(both) : script, options);
      this.addEventListener('message', ({data}) => {
        if (['connected', 'closed'].includes(data?.type)) this.trying = false;
      });
    }
    postMessage(message, ...rest) {
      if (message?.type === 'retry' && this.trying) return;
      // The page talks to the server it came from. The client leaves out the last slash, without which a proxy that
      // serves the page in a folder does not know it, and it lets an address name another server.
      if (message?.type === 'set_server')
        message = {...message, server: new URL('.', location.href).href.replace(/^http/, 'ws')};
      if (['retry', 'set_server'].includes(message?.type)) this.trying = true;
      super.postMessage(message, ...rest);
    }
  };

  // The client keeps an edit back that follows another within 50 ms, and has one place for what it keeps: of three
  // widgets that change within that time, as under a hand that is ahead of a busy page, the second was lost. So the
  // client does not wait, and an edit waits here, only for its own widget, and until the one before is answered at
  // most: under a hand the page then answers as often as it can.
  const INTERVAL = 50;  // [ms]
  const later = window.setTimeout;
  let kept = null, last = null, lastAt = 0, editing = false;
  window.setTimeout = (/** @type {any} */ call, delay, ...rest) => {
    if (!editing || delay !== INTERVAL) return later.call(window, call, delay, ...rest);
    editing = false;
    call();
    return 0;
  };
  function sendKept(send) {
    const edit = kept;
    kept = null;
    if (edit) sendEdit(edit, send);
  }
  function sendEdit(edit, send) {
    last = edit.uuid;
    lastAt = performance.now();
    send(edit);
  }
  function pace(edit, send) {
    if (kept?.uuid !== edit.uuid) sendKept(send());
    const rest = edit.uuid === last ? INTERVAL - (performance.now() - lastAt) : 0;
    if (rest <= 0) { kept = null; sendEdit(edit, send()); }
    else {
      if (!kept) later.call(window, () => sendKept(send()), rest);
      kept = edit;
    }
    editing = true;
    queueMicrotask(() => { editing = false; });
  }

  // The client draws once a second in case something has changed without a word. Where software draws, that alone keeps
  // a processor busy, which the answers wait for: there it is every fifth time, unless a drawing was asked for just
  // before.
  const BEAT = 1000, LATELY = 3000;  // [ms]
  const every = window.setInterval;
  let drawAsked = 0;
  window.setInterval = (/** @type {any} */ call, delay, ...rest) => {
    if (delay !== BEAT) return every.call(window, call, delay, ...rest);
    let beats = 0;
    return every.call(window, () => {
      const asked = performance.now() - drawAsked < LATELY;
      if (beats++ % 5 === 0 || window.rotorScene?.sharp !== false || asked) call(...rest);
    }, delay);
  };

  // The client handles messages for the scene in its next frame, and React draws what follows from them in the one
  // after: here they are handled when they arrive. After each request the client also draws for 250 ms. Where software
  // draws, the next answer would wait for those frames: there it draws once, and again when all has settled. React asks
  // for its own.
  const SETTLED = 250;  // [ms]

  let sender = null;
  window.addEventListener('rx-answered', () => { if (kept && sender) sendKept(sender()); });

  // The client replaces the function that sends when its connection opens and when it ends: then we hear of it.
  let client;
  function watch(next) {
    let send = next.sendMessage;
    sender = () => send;
    const paced = message => message.type === 'GuiUpdateMessage' ? pace(message, () => send) : send(message);
    let draw = next.requestRender, draining = false, tail = 0;
    const request = () => {
      drawAsked = performance.now();
      if (!draining) {
        draining = true;
        try { next.drainMessageQueue?.(); } finally { draining = false; }
      }
      const once = window.rotorScene?.sharp === false && next.scene?.__r3f?.root?.getState?.().invalidate;
      if (!once) return draw();
      once();
      clearTimeout(tail);
      tail = later.call(window, once, SETTLED);
    };
    Object.defineProperty(next, 'requestRender', {
      configurable: true, get: () => request, set: other => { draw = other; },
    });
    next.sendAfterEdits = message => { sendKept(send); send(message); };
    Object.defineProperty(next, 'sendMessage', {get: () => send && paced, set: other => {
      send = other;
      window.dispatchEvent(new CustomEvent('rx-connection', {detail: !/not connected/.test(String(other))}));
    }});
  }
  Object.defineProperty(window, '__viserMutable', {configurable: true, get: () => client, set: next => {
    client = next;
    if (next) watch(next);
  }});

  // Where a node can be dragged, the client refuses what a press does by default, from a listener that is passive: the
  // browser does not obey, and writes an error for each press.
  addEventListener('pointerdown', event => {
    if (event.target instanceof HTMLCanvasElement) event.preventDefault = () => {};
  }, true);

  // A page that can be seen tries again, also where another window has the keyboard, as in front of a class.
  document.hasFocus = () => document.visibilityState === 'visible';
  document.addEventListener('visibilitychange', () => window.dispatchEvent(new Event('focus')));
})();
