"""The page that is served: viser's client with a loading screen until there is something to see.

Without it a visitor looks at an empty window while 800 kB of script unpack, and then at panels and a picture that move
into place one after the other. The loading screen is the first element of the page. It goes when the page has a
solution and its layout is at rest, and comes back when the server returns after a break.
"""

import gzip
import hashlib
from dataclasses import dataclass
from functools import cached_property

TITLE = "Rotor explorer"
_SCRIPT_BEGINS, _HEAD_ENDS, _BODY_BEGINS = "<script", "</head>", "<body>"


@dataclass(frozen=True)
class ServedPage:
    """The served page."""

    html: bytes

    @cached_property
    def packed(self) -> bytes:
        """Compressed by gzip."""
        return gzip.compress(self.html, 6, mtime=0)

    @cached_property
    def tag(self) -> str:
        """ETag: a browser that holds this version need not fetch it again."""
        return f'"{hashlib.sha256(self.html).hexdigest()[:16]}"'


def with_loading_screen(client: str, frame: str = "") -> ServedPage:
    """The client's page with our title, the loading screen, and the `frame` behind it; ValueError for another layout.

    Its script moves from the head behind the loading screen, which is then painted while the script arrives.
    """
    head, begins, rest = client.partition(_SCRIPT_BEGINS)
    script, ends, tail = rest.partition(_HEAD_ENDS)
    before, body, content = tail.partition(_BODY_BEGINS)
    if not (begins and ends and body) or before.strip() or "<title>" not in head:
        raise ValueError("The client's page is not built as expected: a head that ends in its script, then a body.")
    title, _, after = head.partition("<title>")
    head = f"{title}<title>{TITLE}{after[after.index('</title>') :]}"
    return ServedPage(
        f"{head}<style>{_STYLE}</style>{ends}{body}{_LOADING_SCREEN}{frame}{begins}{script}{content}".encode()
    )


_STYLE = """
#rx-veil { position: fixed; inset: 0; z-index: 10000; display: flex; flex-direction: column; gap: 14px;
  align-items: center; justify-content: center; text-align: center; background: #fff; color: #495057;
  font: 14px/1.45 system-ui, -apple-system, "Segoe UI", Roboto, Arial, sans-serif; transition: opacity .16s; }
#rx-veil.rx-dark { background: #141414; color: #a6a7ab; }
#rx-veil.rx-lifting { opacity: 0; pointer-events: none; }
#rx-veil b { font-size: 19px; font-weight: 600; letter-spacing: -.2px; color: #212529; }
#rx-veil.rx-dark b { color: #e9ecef; }
#rx-veil p { margin: 0; min-height: 3em; width: min(29em, 92vw); }
#rx-veil svg { width: 76px; height: 76px; fill: none; stroke: currentColor; }
#rx-veil g { transform-origin: 50px 50px; animation: rx-turn 3.2s linear infinite; }
@keyframes rx-turn { to { transform: rotate(-360deg); } }
@media (prefers-reduced-motion: reduce) { #rx-veil g { animation: none; } }
.rx-veiled #root, .rx-veiled [class*=Notifications-root], .rx-veiled .mantine-Modal-root { visibility: hidden; }
#rx-gone { position: fixed; z-index: 10001; left: 50%; top: 14px; transform: translateX(-50%);
  max-width: min(560px, 92vw);
  padding: 9px 16px 10px; border-radius: 6px; background: #c92a2a; color: #fff; box-shadow: 0 3px 16px rgba(0,0,0,.28);
  font: 13.5px/1.42 system-ui, -apple-system, "Segoe UI", Roboto, Arial, sans-serif; }
"""

_LOADING_SCREEN = """<div id="rx-veil"><svg viewBox="0 0 100 100"><circle cx="50" cy="50" r="46" stroke-opacity=".28"/>
<g stroke-width="4.5" stroke-linecap="round"><path d="M57 50H95M43 50H5M50 43V5M50 57V95"/>
<circle cx="50" cy="50" r="3"/></g>
</svg><b>Rotor explorer</b><p>Opening …</p></div>
<script>(() => {
  const SLOW = 6000, ENOUGH = 25000, BRIEF = 1200;  // [ms]
  const page = document.documentElement, veil = document.getElementById('rx-veil'), words = veil.querySelector('p');
  const asked = new URLSearchParams(location.search).has('darkMode');
  const sign = '[data-explorer=status], [data-explorer=lobby]';
  let begun = 0, calm = 0, last = '', down = false;

  function lay() {
    begun = performance.now(); calm = 0; last = '';
    veil.classList.toggle('rx-dark', page.dataset.mantineColorScheme === 'dark' || asked
      || (!page.dataset.mantineColorScheme && matchMedia('(prefers-color-scheme: dark)').matches));
    veil.classList.remove('rx-lifting');
    veil.style.display = '';
    page.classList.add('rx-veiled');
    requestAnimationFrame(look);
  }

  // At rest: there is an answer, and the picture has kept its place for some frames.
  function look() {
    const canvas = document.querySelector(sign) && document.querySelector('canvas');
    const place = canvas ? JSON.stringify(canvas.getBoundingClientRect()) : '';
    calm = place && place === last ? calm + 1 : 0;
    last = place;
    const took = performance.now() - begun;
    if (calm >= 3 || took > ENOUGH) return lift();
    if (took > SLOW) words.textContent = 'This takes longer than it should: the server is busy, or cannot be reached. '
      + 'The page goes on trying.';
    requestAnimationFrame(look);
  }

  function lift() {
    page.classList.remove('rx-veiled');
    veil.classList.add('rx-lifting');
    setTimeout(() => { if (veil.classList.contains('rx-lifting')) veil.style.display = 'none'; }, 200);
  }

  function say(gone) {
    const before = document.getElementById('rx-gone');
    if (!gone || before) { if (!gone && before) before.remove(); return; }
    const note = document.createElement('div');
    note.id = 'rx-gone';
    note.setAttribute('role', 'alert');
    note.textContent = 'Connection lost; retrying. The address of this page holds your design.';
    document.body.append(note);
  }

  // The client replaces the function that sends when its connection opens and when it ends.
  function watch(client) {
    let send = client.sendMessage;
    Object.defineProperty(client, 'sendMessage', {get: () => send, set: next => {
      send = next;
      const was = down;
      down = /not connected/.test(String(next));
      if (down && !was) setTimeout(() => say(down), BRIEF);
      if (!down) { say(false); if (was) lay(); }
    }});
  }
  let client;
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
  lay();
})();</script>
"""
