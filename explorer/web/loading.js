// @ts-check
// The veil goes when the page has an answer and its layout is at rest, and comes back when the server returns.
(() => {
  const SLOW = 6000, ENOUGH = 25000, BRIEF = 300, ASK = 500;  // [ms]
  const page = document.documentElement, veil = document.getElementById('rx-veil'), words = veil.querySelector('p');
  const asked = new URLSearchParams(location.search).has('darkMode');
  const sign = '[data-explorer=status], [data-explorer=lobby]';
  const unanswered = '[data-explorer=status][data-kind=waiting]';
  let begun = 0, calm = 0, last = '', down = false, held = 0, shown = null, stale = false;

  function lay() {
    begun = performance.now(); calm = 0; last = '';
    veil.querySelector('output').replaceChildren();
    veil.classList.toggle('rx-dark', page.dataset.mantineColorScheme === 'dark' || asked
      || (!page.dataset.mantineColorScheme && matchMedia('(prefers-color-scheme: dark)').matches));
    veil.classList.remove('rx-lifting');
    veil.style.display = '';
    page.classList.add('rx-veiled');
    held = begun + ASK;
    ask();
    requestAnimationFrame(look);
  }

  // The first start of all compiles the server's kernels: the veil counts them until there is an answer.
  async function ask() {
    const reply = await fetch('compiling').catch(() => null);
    const said = reply && reply.ok ? (await reply.text()).trim() : '';
    if (said) {
      held = performance.now() + 3 * ASK;
      words.textContent = said;
    }
    if (page.classList.contains('rx-veiled')) setTimeout(ask, ASK);
  }

  // The design of the address is solved while the page's parts arrive: its power stands here before the picture does.
  async function foretell(tries) {
    const reply = await fetch(`first-answer${location.search}`).catch(() => null);
    const [power, ...lines] = reply?.ok ? (await reply.text()).trim().split('\n') : [''];
    if (power) {
      const number = document.createElement('b');
      number.textContent = power;
      const spans = lines.map(line => Object.assign(document.createElement('span'), {textContent: line}));
      veil.querySelector('output').replaceChildren(number, ...spans);
    } else if (tries && page.classList.contains('rx-veiled')) setTimeout(foretell, 120, tries - 1);
  }

  // At rest: there is an answer, and the picture has kept its place, and the camera its, for some frames.
  function look() {
    // What was shown before the connection was lost is no answer: its buttons would speak to a session that has gone.
    const canvas = !stale && document.querySelector(sign) && document.querySelector('canvas');
    const {elements} = window.__viserMutable?.camera?.matrixWorld ?? {};
    const place = canvas ? JSON.stringify([canvas.getBoundingClientRect(), elements]) : '';
    calm = place && place === last ? calm + 1 : 0;
    last = place;
    if (window.RX?.state.line || document.querySelector('[data-explorer=lobby]')) stale = false;
    const now = performance.now();
    const answered = !stale && document.querySelector(sign) && !document.querySelector(unanswered);
    if (!answered && now < held) { begun = now; calm = 0; }
    const took = now - begun;
    if (!stale && (calm >= 3 || took > ENOUGH)) return lift();
    if (took > SLOW) words.textContent = 'This takes longer than it should: the server is busy, or cannot be reached. '
      + 'The page keeps trying.';
    requestAnimationFrame(look);
  }

  function lift() {
    page.classList.remove('rx-veiled');
    const opening = document.querySelector('.rxf-line');
    if (opening && !document.querySelector(sign)) opening.textContent =
      'The server does not answer: it is busy, or this address is wrong. The page keeps trying.';
    hold(false);
    tellLost();
    veil.classList.add('rx-lifting');
    setTimeout(() => { if (veil.classList.contains('rx-lifting')) veil.style.display = 'none'; }, 200);
  }

  // Without a server nothing can be changed, so that no change is lost: what is under way ends.
  function hold(inert) {
    const ends = inert ? ['pointerup', 'mouseup', 'touchend', 'pointercancel'] : [];
    for (const end of ends) document.dispatchEvent(new Event(end, {bubbles: true}));
    for (const part of document.querySelectorAll('#root, #rx')) part.inert = inert;
    page.toggleAttribute('data-held', inert);
  }
  function warn(id, sentence) {
    const note = Object.assign(document.createElement('div'), {id, role: 'alert', textContent: sentence});
    document.body.append(note);
    return note;
  }
  // Sliders by name: the value that was set when the connection broke may not have arrived.
  function sliders() {
    const found = new Map();
    for (const thumb of document.querySelectorAll('[data-dock-region=right] .mantine-Slider-root [role=slider]'))
      if (thumb.ariaLabel) found.set(thumb.ariaLabel, thumb.ariaValueNow);
    return found;
  }
  function tellLost(tries = 50) {
    const now = sliders();
    if (shown && tries && [...shown.keys()].some(name => !now.has(name))) return setTimeout(tellLost, 100, tries - 1);
    const lost = [...shown ?? []].filter(([name, value]) => now.has(name) && now.get(name) !== value)
      .map(([name, value]) => `${name} was ${value}, is ${now.get(name)}`);
    shown = null;
    if (!lost.length) return;
    const note = warn('rx-lost',
      `The connection was lost before your last change arrived: ${lost.join('; ')}. Set it again.`);
    addEventListener('pointerdown', () => note.remove(), {once: true, capture: true});
  }

  function say(gone) {
    const before = document.getElementById('rx-gone');
    if (!gone) before?.remove();
    else if (!before) warn('rx-gone', 'Connection lost; retrying. You cannot change anything until it returns. '
      + 'The address of this page holds your design.');
  }

  window.addEventListener('rx-connection', ({detail: open}) => {
    const was = down;
    down = !open;
    if (down && !was) {
      shown ??= sliders();
      hold(true);
      setTimeout(() => say(down), BRIEF);
    }
    if (open) say(false);
    if (open && was) { RX.forget(); stale = true; lay(); }
  });
  lay();
  foretell(40);
})();
