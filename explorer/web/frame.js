// The frame: takes parts of the page's state from Python, draws what has changed, and reports what is pressed.
(() => {
  const ICONS = {
    undo: 'M4 9h10a6 6 0 0 1 0 12h-3M4 9l5-5M4 9l5 5', redo: 'M20 9H10a6 6 0 0 0 0 12h3M20 9l-5-5M20 9l-5 5',
    pin: 'M12 16v6M8 3h8l-1 7 3 5H6l3-5z', share: 'M12 15V3M7 8l5-5 5 5M5 13v7h14v-7', play: 'M7 4l13 8-13 8z', pause: 'M8 5v14M16 5v14',
    folder: 'M3 6h6l2 3h10v10H3z', sliders: 'M4 7h9M19 7h1M4 17h3M13 17h7M16 4v6M10 14v6', chart: 'M4 4v16h16M7 15l4-5 3 3 5-7',
    gear: 'M12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6zM12 3v2.5M12 18.500V21M3 12h2.500M18.5 12H21M5.6 5.600l1.8 1.800M16.6 16.600l1.8 1.800M18.4 5.600l-1.8 1.800M7.4 16.600l-1.8 1.8',
    hand: 'M8 12V5.500a1.6 1.6 0 0 1 3.2 0V11 4.200a1.6 1.6 0 0 1 3.2 0V11 6.200a1.6 1.6 0 0 1 3.2 0V15c0 4-2.6 6.5-6.2 6.5-3.2 0-4.7-1.6-6-4.200l-2-3.700a1.5 1.5 0 0 1 2.6-1.500z',
  };
  const icon = name => `<svg class="rxf-icon" viewBox="0 0 24 24" aria-hidden="true"><path d="${ICONS[name]}"/></svg>`;
  const page = document.documentElement, root = document.getElementById('rx');
  const part = name => root.querySelector(`[data-part=${name}]`);
  const state = {}, painters = {}, later = new Set();
  let bridge = null, serial = 0, frame = 0, sessions = 0;

  const RX = window.RX = {
    state, icon, part,
    text: Charts.text,  // Written into HTML.
    // Draw `state[name]` with this function, once a frame at most.
    paint(name, draw) { painters[name] = draw; },
    // And after it this.
    also(name, draw) { const first = painters[name]; painters[name] = value => { first?.(value); draw(value); }; },
    again(...names) {
      for (const name of names) later.add(name);
      frame ||= requestAnimationFrame(() => {
        frame = 0;
        const due = [...later];
        later.clear();
        for (const name of due) if (name in state) painters[name]?.(state[name]);
      });
    },
    // From Python: the text widget that takes our messages; later, parts of the state.
    begin(uuid) { RX.forget(); bridge = uuid; for (const name of Object.keys(state)) delete state[name]; page.removeAttribute('data-lecture'); page.removeAttribute('data-big'); },
    // The session has gone: nothing is sent until another begins.
    forget() { bridge = null; sessions++; delete state.power; },
    set(parts) {
      for (const [name, value] of Object.entries(parts)) { state[name] = value; RX.again(name); }
      if ('power' in parts) window.dispatchEvent(new Event('rx-answered'));
    },
    // To Python: what is wanted, and of what. A serial number makes every message another one.
    send(name, value = null) {
      const client = window.__viserMutable;
      if (!client?.sendMessage || bridge === null) return;
      client.sendAfterEdits({type: 'GuiUpdateMessage', uuid: bridge, updates: {value: JSON.stringify([++serial, name, value])}});
    },
    // For tests: true once all that was sent is answered and drawn, and nothing more was sent meanwhile; wholly, once the
    // server computes nothing more for this page, searches apart. It gives the number back that it is sent.
    async idle(wholly = false) {
      const drawn = () => new Promise(requestAnimationFrame);
      for (let asked = -1; asked !== serial;) {
        await drawn();  // A slider that is moved changes in the next frame; nothing is kept back for longer than 120 ms then.
        await new Promise(done => setTimeout(done, 150));
        while (bridge === null) await drawn();
        const session = sessions;
        RX.send('idle', [asked = serial + 1, wholly]);
        while (state.idle !== asked && session === sessions) await drawn();
        if (session !== sessions) asked = -1;
        await drawn();
        await drawn();
      }
      return true;
    },
    say(sentence) { const place = root.querySelector('.rxf-said'); if (place.textContent !== sentence) place.textContent = sentence; },
  };

  for (const button of root.querySelectorAll('[data-icon]')) button.insertAdjacentHTML('afterbegin', icon(button.dataset.icon));
  for (const button of root.querySelectorAll('.rxf-tools button'))
    if (!button.ariaLabel) button.ariaLabel = button.textContent.trim();

  // Everything with data-do reports itself; what has data-page acts here.
  document.addEventListener('click', event => {
    const near = event.target instanceof Element && event.target.closest('[data-do], [data-page]');
    const menu = part('menu');
    // A notification that closes by itself does so by a click on its button, below: nobody has pressed beside the menu.
    const inside = event.target instanceof Element && event.target.closest('[data-part=menu], .mantine-Notification-root');
    if (!menu.hidden && !inside && near?.dataset.do !== 'pin') menu.hidden = true;
    if (!near || near.disabled || near.matches('select, input[type=range]')) return;
    if (near.dataset.page) return toggle(near.dataset.page);
    if (near.dataset.do === 'pin' && state.bar?.pinned && near.closest('.rxf-bar')) return pinMenu(near);
    if (near.dataset.do === 'mode') mark(near.dataset.value);
    // In a narrow window a mode brings its controls along, and a view makes room for itself.
    if (near.dataset.do === 'mode' && innerWidth <= 1100) openRail(true);
    if (near.dataset.do === 'view' && innerWidth <= 860) openRail(false);
    if (near.closest('[data-part=menu]') && near.dataset.do !== 'along') menu.hidden = true;
    RX.send(near.dataset.do, near.type === 'checkbox' ? near.checked : near.dataset.value ?? null);
  });
  // The browser makes no click where what was pressed is drawn anew before the release, as a card is with every answer:
  // then the same control under the pointer is clicked here.
  let pressed = null;
  const control = target => target instanceof Element ? target.closest('[data-do], [data-page], [data-harmonic]') : null;
  const same = (one, other) => ['do', 'value', 'page', 'harmonic'].every(name => one.dataset[name] === other.dataset[name]);
  document.addEventListener('pointerdown', event => { pressed = event.button === 0 ? {target: event.target, control: control(event.target)} : null; }, true);
  document.addEventListener('pointerup', event => {
    const was = pressed, now = control(event.target);
    pressed = null;
    if (was?.control && now && !was.target.isConnected && same(was.control, now)) now.dispatchEvent(new MouseEvent('click', {bubbles: true}));
  }, true);
  // A link to be passed on, not followed.
  document.addEventListener('click', event => {
    const link = event.target instanceof Element && event.target.closest('a[data-copy]');
    if (!link || !navigator.clipboard) return;
    event.preventDefault();
    navigator.clipboard.writeText(link.href).then(() => RX.say('Link copied'), () => window.open(link.href, '_blank', 'noopener'));
  });
  document.addEventListener('change', event => {
    if (event.target.matches?.('#rx select[data-do]')) { RX.send(event.target.dataset.do, event.target.value); event.target.blur(); }
  });
  let turning = 0;
  document.addEventListener('input', event => {
    if (!event.target.matches?.('#rx input[type=range]')) return;
    clearTimeout(turning);
    turning = setTimeout(() => RX.send(event.target.dataset.do, Number(event.target.value)), 30);
  });
  // A slider of the design is held from the press to the release; viser sends its last value up to 50 ms later.
  let holding = false;
  addEventListener('pointerdown', event => {
    if (page.dataset.mode === 'optimise' || !event.isPrimary || !(event.target instanceof Element) || !event.target.closest('[data-dock-region=right] .mantine-Slider-root')) return;
    holding = true;
    RX.send('hold', true);
  }, true);
  for (const end of ['pointerup', 'pointercancel'])
    addEventListener(end, event => { if (holding && event.isPrimary) { holding = false; setTimeout(() => RX.send('hold', false), 80); } }, true);
  // A double click on the handle of a slider, or on its label, puts it back.
  document.addEventListener('dblclick', event => {
    const near = event.target instanceof Element && event.target.closest('.mantine-Slider-thumb, label'), row = near && near.closest('[class*=Flex-root]:has(.mantine-Slider-root):has(label)');
    if (row && row.closest('[data-dock-region]')) RX.send('default', row.querySelector('label').textContent);
  });
  // Keys pressed in the frame's own controls are theirs alone.
  root.addEventListener('keydown', event => {
    if (event.target.matches('select, input') || (event.target.matches('button') && (event.key === ' ' || event.key === 'Enter'))) event.stopPropagation();
  });
  document.addEventListener('keydown', event => {
    // In a field, Escape leaves the field and no more.
    if (event.key !== 'Escape' || event.target.matches?.('input:not([type=range], [type=checkbox])')) return;
    if (!part('menu').hidden) part('menu').hidden = true;
    else if (state.bar?.drawer && !document.querySelector('dialog[open]')) RX.send('drawer', '');
  });

  function toggle(name) {
    if (name === 'rail' && state.bar?.drawer) {  // In a narrow window one of the two has room.
      RX.send('drawer', '');
      if (page.dataset.rail === 'open') return;
    }
    open(name, page.dataset[name] !== 'open');
  }
  function open(name, wanted) {
    if (wanted) page.dataset[name] = 'open'; else delete page.dataset[name];
    for (const button of root.querySelectorAll(`[data-page=${name}]`)) button.ariaExpanded = String(wanted);
    window.dispatchEvent(new Event('resize'));
  }
  const openRail = RX.openRail = wanted => open('rail', wanted);
  if (innerWidth <= 860) openRail(true);
  // The sheet follows the finger that pulls its edge; the canvas takes its new size when it is let go.
  const grip = root.querySelector('.rxf-grip');
  let pull = null, pulled = false;
  grip.addEventListener('pointerdown', event => {
    const high = Number.parseFloat(getComputedStyle(document.querySelector('[data-dock-region=right]') ?? grip).height);
    pulled = false;
    pull = {y: event.clientY, high: page.matches('[data-drawer], [data-rail=open]') ? high : 0, moved: false};
    grip.setPointerCapture(event.pointerId);
  });
  grip.addEventListener('pointermove', event => {
    if (!pull || (!pull.moved && Math.abs(event.clientY - pull.y) < 6)) return;
    if (!pull.moved) page.style.setProperty('--rx-under', `${pull.high}px`);
    pull.moved = true;
    pull.now = Math.min(Math.max(pull.high + pull.y - event.clientY, 0), 0.62 * innerHeight);
    page.style.setProperty('--rx-pulled', `${pull.now}px`);
    if (!page.matches('[data-drawer]')) page.dataset.rail = 'open';
  });
  grip.addEventListener('click', event => { if (pulled && event.detail) event.stopPropagation(); });  // It ends a pull and is no press.
  grip.addEventListener('pointercancel', () => { pull = null; page.style.removeProperty('--rx-under'); });
  grip.addEventListener('pointerup', () => {
    const {moved, now} = pull ?? {};
    pull = null;
    page.style.removeProperty('--rx-under');
    if (!moved) return;
    if (now < 90) page.style.removeProperty('--rx-pulled');
    if (now < 90 && state.bar?.drawer) RX.send('drawer', '');
    openRail(now >= 90);
    pulled = true;
  });

  function mark(mode) {
    for (const button of root.querySelectorAll('.rxf-modes button')) button.setAttribute('aria-current', String(button.dataset.value === mode));
    page.dataset.mode = mode;
  }

  RX.paint('bar', bar => {
    const menu = root.querySelector('.rxf-rotor'), names = JSON.stringify(bar.rotors);
    if (menu.dataset.names !== names) {
      menu.dataset.names = names;
      menu.innerHTML = bar.rotors.map(([name, title]) => `<option value="${RX.text(name)}">${RX.text(title)}</option>`).join('');
    }
    if (document.activeElement !== menu || menu.value !== bar.rotor) menu.value = bar.rotor;
    menu.disabled = bar.held;
    mark(bar.mode);
    for (const name of ['undo', 'redo']) root.querySelector(`[data-do=${name}]`).disabled = !bar[name] || bar.held;
    const pin = root.querySelector('.rxf-tools [data-do=pin]');
    pin.disabled = bar.held;
    pin.toggleAttribute('data-on', Boolean(bar.pinned));
    pin.querySelector('span').textContent = bar.pinned ? 'A pinned ▾' : 'Pin A';
    pin.ariaLabel = bar.pinned ? `A is ${bar.pinned.title}` : 'Pin A';
    page.toggleAttribute('data-drawer', Boolean(bar.drawer));
    for (const button of root.querySelectorAll('.rxf-tools [data-do=drawer]')) button.ariaExpanded = String(button.dataset.value === bar.drawer);
    if (!part('menu').hidden && bar.pinned) pinMenu(pin, true);
  });

  function pinMenu(button, keep) {
    const menu = part('menu'), {pinned} = state.bar;
    if (!keep && !menu.hidden) { menu.hidden = true; return; }
    menu.innerHTML = `<p data-explorer="pinned"><b style="color:var(--rx-pinned)">A</b> ${RX.text(pinned.title)}<br>
      <span class="rxf-dim rxf-num">${RX.text(pinned.power)}</span></p>
      <button data-do="swap">Swap A and B</button><button data-do="back">Back to A</button>
      <label><input type="checkbox" data-do="along" ${pinned.along ? 'checked' : ''}>Fly A at the current condition</label>
      <button data-do="pin">Unpin</button>`;
    const place = button.getBoundingClientRect();
    menu.style.top = `${place.bottom + 6}px`;
    menu.style.left = `${Math.max(8, Math.min(place.left, innerWidth - 300))}px`;
    if (menu.hidden) { menu.hidden = false; menu.querySelector('button').focus(); }
  }

  RX.paint('views', views => {
    part('views').innerHTML = views.all.map(([name, title]) =>
      `<button data-do="view" data-value="${name}" aria-pressed="${name === views.now}">${RX.text(title)}</button>`).join('');
  });
  RX.paint('notice', notice => {
    const place = part('notice');
    place.hidden = !notice;
    if (!notice) return;
    // Its buttons stay the same ones while its words change with every design tried: a press must not meet a new one.
    const actions = JSON.stringify(notice.actions);
    if (place.dataset.actions !== actions) {
      place.dataset.actions = actions;
      place.innerHTML = '<span data-explorer="notice"></span>' + notice.actions.map(([name, title]) => `<button data-do="${name}">${RX.text(title)}</button>`).join('');
    }
    place.querySelector('span').textContent = notice.text;
  });
  RX.paint('prompt', words => {
    const place = part('prompt');
    place.hidden = !words;
    if (words) place.innerHTML = icon('hand') + `<span data-explorer="prompt">${RX.text(words.text)}</span>`;
  });
  // Which fractions of the canvas cards cover along its width, so that the camera shows its subject between them. The
  // card of power grows with its sentence: it counts with its usual height, or the scene would move with every change.
  let telling = 0;
  function tellCover() {
    clearTimeout(telling);
    telling = setTimeout(() => {
      const stage = root.querySelector('.rxf-stage').getBoundingClientRect(), seen = name => root.querySelector(name).getClientRects()[0];
      if (!stage.height) return;
      const wide = ['.rxf-inset', '.rxf-field', '.rxf-fly', '.rxs-figures'].map(seen).filter(box => box && box.width > 0.28 * stage.width).concat(seen('.rxs-wipe > span') ?? []);
      const high = wide.filter(box => box.top <= stage.top + stage.height / 3), low = wide.filter(box => !high.includes(box)), notice = seen('.rxf-notice');
      if (notice?.width > 0.6 * stage.width) high.push(notice);  // A bar beside the subject does not move the camera.
      const above = Math.max(seen('.rxf-power') ? (stage.width > 470 ? 118 : 70) + (state.vibration ? 30 : 0) : 0, ...high.map(box => (box?.bottom ?? stage.top) - stage.top));
      const below = low.length ? stage.bottom - Math.min(...low.map(box => box.top)) : 0;
      RX.send('covered', RX.covered = [above / stage.height, below / stage.height]);
    }, page.classList.contains('rx-veiled') ? 0 : 120);  // Below the veil at once, so that the camera stands when it lifts.
  }
  RX.also('vibration', tellCover);
  for (const name of ['.rxf-inset', '.rxf-field', '.rxf-fly', '.rxf-notice', '.rxs-figures']) new ResizeObserver(tellCover).observe(root.querySelector(name));
  // The card of power grows with its words: what stands below it follows.
  new ResizeObserver(() => {
    const card = root.querySelector('.rxf-power');
    if (card.offsetHeight) root.style.setProperty('--rx-power', card.offsetTop + card.offsetHeight + 'px');
  }).observe(root.querySelector('.rxf-power'));
  for (const name of ['inset', 'strip']) new ResizeObserver(() => RX.again(name)).observe(part(name));  // Drawn for their size; the plan hides them.

  // Words at points of the scene; each of these parts of the state is a list of them.
  const LABELS = ['lifted_labels', 'probe_label', 'hub_labels'];
  const LABEL_SHIFT = 60;  // [px]
  let labels = [];
  for (const name of LABELS) RX.paint(name, () => {
    labels = LABELS.flatMap(one => state[one] ?? []);
    const all = part('labels');  // They stay where they are, and new ones are unseen, until they are placed.
    while (all.children.length > labels.length) all.lastChild.remove();
    while (all.children.length < labels.length) all.insertAdjacentHTML('beforeend', '<span class="rxf-label rxf-num" style="visibility:hidden"></span>');
    labels.forEach((one, k) => {
      Object.assign(all.children[k], {textContent: one.text, title: one.title ?? ''});
      all.children[k].dataset.kind = one.kind ?? '';
    });
  });
  function placeLabels(client, box) {
    const taken = [], cards = [...root.querySelectorAll('.rxf-stage > .rxf-card, .rxf-low > .rxf-card')].map(card => card.getBoundingClientRect()).filter(card => card.width).map(card => [card.left - box.left, card.top - box.top, card.width, card.height]);
    labels.forEach((one, k) => {
      const node = client.nodeRefFromName?.[one.node], label = part('labels').children[k];
      if (!label) return;
      let seen = Boolean(node);
      for (let above = node; above; above = above.parent) seen &&= above.visible;
      if (!seen || !client.camera) { label.style.visibility = 'hidden'; return; }
      const at = node.position.clone().set(...one.at).applyMatrix4(node.matrixWorld).project(client.camera);
      let left = (at.x + 1) / 2 * box.width - label.offsetWidth / 2, top = (1 - at.y) / 2 * box.height - label.offsetHeight;
      left = Math.max(4, Math.min(left, box.width - label.offsetWidth - 4));
      top = Math.max(4, top);
      // None lies behind a card or over another: it goes below what it meets, but not far from its point.
      const [wide, high, wanted] = [label.offsetWidth, label.offsetHeight, top];
      const met = () => [...taken, ...cards].find(([x, y, w, h]) => left < x + w && x < left + wide && top < y + h && y < top + high);
      for (let other; top - wanted < LABEL_SHIFT && (other = met());) top = other[1] + other[3] + 2;
      const free = !met();
      seen = free && at.z < 1 && Math.abs(at.x) < 1 && Math.abs(at.y) < 1;
      if (seen) taken.push([left, top, wide, high]);
      label.style.visibility = seen ? 'visible' : 'hidden';
      label.style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px)`;
    });
  }

  // Where the canvas is: cards follow it; and the prompt follows a node of the scene.
  let place = '', hooked = null;
  function look() {
    requestAnimationFrame(look);
    const client = window.__viserMutable, canvas = client?.canvas;
    if (!canvas) return;
    const box = canvas.getBoundingClientRect(), now = [box.left, box.top, box.width, box.height].join();
    if (now !== place) {
      place = now;
      for (const [name, value] of [['--rx-x', box.left], ['--rx-y', box.top], ['--rx-w', box.width], ['--rx-h', box.height]]) page.style.setProperty(name, `${value}px`);
      for (let e = canvas.parentElement; e && e.id !== 'root'; e = e.parentElement) if (/background-color/.test(e.getAttribute('style') ?? '')) e.classList.add('rxf-ground');
      RX.again('inset', 'strip', 'twist');
      tellCover();
    }
    // What belongs to a point of a turning blade is placed once more when the blade is drawn: else it is a frame late.
    const {scene} = client;
    if (scene && scene !== hooked) {
      const after = scene.onAfterRender;
      hooked = scene;
      scene.onAfterRender = (...all) => { after.apply(scene, all); placeWords(client); };
    }
    placeWords(client);
  }
  function placeWords(client) {
    const box = client.canvas.getBoundingClientRect();
    if (labels.length) placeLabels(client, box);
    const words = state.prompt, node = words && client.nodeRefFromName?.[words.node];
    if (!node || !client.camera) return;
    const at = node.position.clone().set(...words.at).applyMatrix4(node.matrixWorld).project(client.camera), prompt = part('prompt');
    const left = (at.x + 1) / 2 * box.width - 0.8 * prompt.offsetWidth, top = (1 - at.y) / 2 * box.height + 20;
    prompt.style.transform = `translate(${Math.max(8, Math.min(left, box.width - prompt.offsetWidth - 8))}px, ${Math.max(8, Math.min(top, box.height - 60))}px)`;
  }
  requestAnimationFrame(look);
  // viser's remark on drawing in software is said for a while, and then makes room.
  new MutationObserver(() => {
    for (const note of document.querySelectorAll('.mantine-Notification-root:not([data-seen])')) {
      note.dataset.seen = '';
      if (/Software WebGL/.test(note.textContent)) setTimeout(() => note.querySelector('button')?.click(), 5000);
    }
  }).observe(document.body, {childList: true, subtree: true});
  // What viser mounts anew is filled anew.
  new MutationObserver(() => { RX.again('twist', 'worth'); Charts.find(); }).observe(document.getElementById('root') ?? document.body, {childList: true, subtree: true});
})();
