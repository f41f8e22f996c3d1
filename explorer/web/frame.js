// @ts-check
// The frame: takes parts of the page's state from Python, draws what has changed, and reports what is pressed.
(() => {
  const {text, clamp, lerp, write, closest, soon, drag, viewer, node, project, follow} = Common;
  const ICONS = {
    undo: 'M4 9h10a6 6 0 0 1 0 12h-3M4 9l5-5M4 9l5 5', redo: 'M20 9H10a6 6 0 0 0 0 12h3M20 9l-5-5M20 9l-5 5',
    pin: 'M12 16v6M8 3h8l-1 7 3 5H6l3-5z', share: 'M12 15V3M7 8l5-5 5 5M5 13v7h14v-7',
    play: 'M7 4l13 8-13 8z', pause: 'M8 5v14M16 5v14', folder: 'M3 6h6l2 3h10v10H3z',
    sliders: 'M4 7h9M19 7h1M4 17h3M13 17h7M16 4v6M10 14v6', more: 'M5 12h.1M12 12h.1M19 12h.1',
    gear: 'M12 9a3 3 0 1 0 0 6 3 3 0 0 0 0-6zM12 3v2.5M12 18.5V21M3 12h2.5M18.5 12H21'
      + 'M5.6 5.6l1.8 1.8M16.6 16.6l1.8 1.8M18.4 5.6l-1.8 1.8M7.4 16.6l-1.8 1.8',
    hand: 'M8 12V5.5a1.6 1.6 0 0 1 3.2 0V11 4.2a1.6 1.6 0 0 1 3.2 0V11 6.2a1.6 1.6 0 0 1 3.2 0V15c0 4-2.6 6.5-6.2 6.5'
      + '-3.2 0-4.7-1.6-6-4.2l-2-3.7a1.5 1.5 0 0 1 2.6-1.5z',
  };
  const icon = name => `<svg class="rxf-icon" viewBox="0 0 24 24" aria-hidden="true"><path d="${ICONS[name]}"/></svg>`;
  const page = document.documentElement, root = document.getElementById('rx');
  const part = name => root.querySelector(`[data-part=${name}]`);
  const state = /** @type {Partial<RxState>} */ ({}), painters = [], changed = new Set();
  let bridge = null, serial = 0, sessions = 0;
  const paintChanged = soon(() => {
    const due = new Set(changed);
    changed.clear();
    for (const {names, draw} of painters)
      if (names[0] in state && names.some(name => due.has(name))) draw(...names.map(name => state[name]));
  });

  const RX = window.RX = /** @type {Window['RX']} */ ({
    state, icon, part, shown: name => state[name],
    // Draw with this function, once a frame at most, where one of these parts of the state has changed and the first is
    // known. It draws into elements of its own, and reads whatever it needs.
    paint(names, draw) { painters.push({names: [names].flat(), draw}); },
    again(...names) {
      for (const name of names) changed.add(name);
      paintChanged();
    },
    // From Python: the text widget that takes our messages; later, parts of the state.
    begin(uuid) {
      RX.forget();
      bridge = uuid;
      for (const name in state) delete state[name];
      for (const name of ['data-lecture', 'data-big']) page.removeAttribute(name);
    },
    // The session has gone: nothing is sent until another begins.
    forget() { bridge = null; sessions++; delete state.line; },
    set(parts) {
      Object.assign(state, parts);
      RX.again(.../** @type {(keyof RxState)[]} */ (Object.keys(parts)));
      if ('line' in parts) window.dispatchEvent(new Event('rx-answered'));
    },
    // To Python: what is wanted, and of what. A serial number makes every message another one.
    send(name, value) {
      const client = viewer();
      if (!client?.sendMessage || bridge === null) return;
      const updates = {value: JSON.stringify([++serial, name, value ?? null])};
      client.sendAfterEdits({type: 'GuiUpdateMessage', uuid: bridge, updates});
    },
    // The hand holds something; the function that is returned lets go, after what was sent last has come [ms].
    hold(after = 80) {
      RX.send('hold', true);
      return () => { setTimeout(() => RX.send('hold', false), after); };
    },
    // For tests: true once all that was sent is answered and drawn, and nothing more was sent meanwhile; wholly, once
    // the server computes nothing more for this page, searches apart. It gives the number back that it is sent.
    async idle(wholly = false) {
      const drawn = () => new Promise(requestAnimationFrame);
      for (let asked = -1; asked !== serial || telling;) {
        await drawn();  // A slider that is moved changes in the next frame; else nothing is kept back over 120 ms.
        await new Promise(done => setTimeout(done, 150));
        while (bridge === null || telling) await drawn();  // What cards cover moves the camera.
        const session = sessions;
        RX.send('idle', [asked = serial + 1, wholly]);
        while ((state.idle ?? -1) < asked && session === sessions) await drawn();
        if (session !== sessions) asked = -1;
        await drawn();
        await drawn();
      }
      return true;
    },
    say(sentence) {
      const spoken = root.querySelector('.rxf-said');
      if (spoken.textContent !== sentence) spoken.textContent = sentence;
    },
  });

  for (const button of root.querySelectorAll('[data-icon]'))
    button.insertAdjacentHTML('afterbegin', icon(button.dataset.icon));
  for (const button of root.querySelectorAll('.rxf-tools button')) button.ariaLabel ||= button.textContent.trim();

  // Everything with data-do reports itself; what has data-page acts here.
  document.addEventListener('click', event => {
    const control = closest(event, '[data-do], [data-page]'), {do: action, value, page: panel} = control?.dataset ?? {};
    const menu = part('menu');
    // A notification that closes by itself does so by a click on its button, below: nobody has pressed beside the menu.
    const inside = closest(event, '[data-part=menu], .mantine-Notification-root');
    if (!inside && action !== 'pin') menu.hidden = true;
    if (!control || control.disabled || control.matches('select, input[type=range]')) return;
    if (panel) return toggle(panel);
    if (action === 'pin' && state.bar?.pinned && control.closest('.rxf-bar')) return pinMenu(control);
    if (action === 'mode') mark(value);
    // In a narrow window a mode brings its controls along, in the place of a drawer too; a view makes room for itself.
    if (action === 'mode' && small.matches && state.bar?.drawer) RX.send('drawer', '');
    if (action === 'mode' && (innerWidth <= 1100 || small.matches)) showTab('controls', true);
    if (action === 'view' && small.matches) openRail(beside());
    if (inside === menu && action !== 'along') menu.hidden = true;
    RX.send(action, control.type === 'checkbox' ? control.checked : value ?? null);
  });
  // The browser makes no click where what was pressed is drawn anew before the release, as a card is with every answer:
  // then the same control under the pointer is clicked here.
  let pressed = null, onDisk = null;  // Where from the left [px] the disk was pressed, if it was that last.
  const controlOf = event => closest(event, '[data-do], [data-page], [data-harmonic], [data-unfold], [data-mission]');
  const NAMES = ['do', 'value', 'page', 'harmonic', 'unfold', 'mission'];
  document.addEventListener('pointerdown', event => {
    pressed = event.button === 0 ? {target: event.target, control: controlOf(event)} : null;
    onDisk = closest(event, 'canvas, .rxf-plan') ? event.clientX : null;
  }, true);
  document.addEventListener('pointerup', event => {
    const before = pressed?.control, control = controlOf(event), lost = before && !pressed.target.isConnected;
    pressed = null;
    if (lost && control && NAMES.every(name => before.dataset[name] === control.dataset[name]))
      control.dispatchEvent(new MouseEvent('click', {bubbles: true}));
  }, true);
  document.addEventListener('change', event => {
    const menu = closest(event, '#rx select[data-do]');
    if (!menu) return;
    RX.send(menu.dataset.do, menu.value);
    menu.blur();
  });
  let turning = 0;
  document.addEventListener('input', event => {
    const slider = closest(event, '#rx input[type=range]');
    if (!slider) return;
    clearTimeout(turning);
    turning = setTimeout(() => RX.send(slider.dataset.do, Number(slider.value)), 30);
  });
  // A slider of the design is held from the press to the release; viser sends its last value up to 50 ms later.
  drag(window, '[data-dock-region=right] .mantine-Slider-root',
    () => page.dataset.mode === 'optimise' ? null : {end: RX.hold()}, true);
  // A double click on the handle of a slider, or on its label, puts it back.
  document.addEventListener('dblclick', event => {
    const row = closest(event, '.mantine-Slider-thumb, label')
      ?.closest('[class*=Flex-root]:has(.mantine-Slider-root):has(label)');
    if (row?.closest('[data-dock-region]')) RX.send('default', row.querySelector('label').textContent);
  });
  // Which dock the pointer is over. A style sheet that asked html for it by :has would have the whole page styled anew
  // with everything drawn, once a hint was shown.
  document.addEventListener('pointerover', event => {
    page.dataset.over = closest(event, '[data-dock-region]')?.dataset.dockRegion ?? '';
  });
  // Keys pressed in the frame's own controls are theirs alone.
  root.addEventListener('keydown', event => {
    const presses = event.key === ' ' || event.key === 'Enter';
    if (closest(event, '*').matches(`select, input${presses ? ', button' : ''}`)) event.stopPropagation();
  });
  document.addEventListener('keydown', event => {
    onDisk = null;
    // In a field, Escape leaves the field and no more.
    if (event.key !== 'Escape' || closest(event, 'input:not([type=range], [type=checkbox])')) return;
    if (!part('menu').hidden) part('menu').hidden = true;
    else if (state.bar?.drawer && !document.querySelector('dialog[open]')) RX.send('drawer', '');
  });

  // On a telephone or a tablet one sheet holds what stands around the scene else, a tab for each: controls, the key of
  // the disk, charts. A drawer takes the place of all three.
  const small = RX.small = matchMedia('(max-width: 860px), (max-height: 480px)'), more = () => 'more' in page.dataset;
  const beside = () => parseFloat(getComputedStyle(page).getPropertyValue('--rx-side')) > 0;  // Then it stays open.
  function toggle(name) {
    if (name === 'more' || name === 'scale') return;
    if (name === 'load') return location.reload();
    const open = page.dataset.rail === 'open' && !state.bar?.drawer;
    if (state.bar?.drawer) RX.send('drawer', '');
    if (name === 'rail') showTab('controls', !open);
    else showTab(name, beside() || !open || page.dataset.tab !== name);
  }
  const showTab = RX.showTab = (name, wanted) => {
    page.dataset.tab = name;
    openRail(wanted);
    RX.again('plan', 'strip', 'inset');
  };
  const openRail = RX.openRail = wanted => {
    if (wanted) page.dataset.rail = 'open'; else delete page.dataset.rail;
    sayOpen();
    window.dispatchEvent(new Event('resize'));
  };
  function sayOpen() {
    const open = page.dataset.rail === 'open' && !state.bar?.drawer;
    for (const button of root.querySelectorAll('[data-page]:not([data-page=scale])')) {
      const {page: name} = button.dataset;
      button.ariaExpanded = String(name === 'more' ? more() : open && (name === 'rail' || name === page.dataset.tab));
    }
  }
  // What is folded in a low window, by the names of its buttons; a folded strip opens by a press anywhere on it.
  const unfolded = new Set();
  const foldOf = event => closest(event, 'button[data-unfold]')?.dataset.unfold
    ?? (closest(event, 'footer.rxf-strip') && part('strip').clientHeight < FOLDED ? 'charts' : undefined);
  const FOLDED = RX.folded = 60;  // [px] A lower strip of charts is folded.
  document.addEventListener('click', event => {
    const name = foldOf(event);
    if (!name) return;
    if (!unfolded.delete(name)) unfolded.add(name);
    page.dataset.unfolded = [...unfolded].join(' ');
    for (const button of root.querySelectorAll('button[data-unfold]'))
      button.ariaExpanded = String(unfolded.has(button.dataset.unfold));
    window.dispatchEvent(new Event('resize'));
    RX.again('strip', 'inset', 'flight', 'earns', 'suppose');
    tellCover();
  });
  // Any press closes what stands below "More", after it has been heard; a notification that closes is no press.
  document.addEventListener('click', event => {
    if (closest(event, '.mantine-Notification-root')) return;
    page.toggleAttribute('data-more', Boolean(closest(event, '[data-page=more]')) && !more());
    sayOpen();
  });
  function settle() {
    const low = root.querySelector('.rxf-low');
    if (small.matches) root.querySelector('.rxf-sheet').prepend(low); else part('labels').before(low);
  }
  small.addEventListener('change', settle);
  settle();
  showTab('controls', small.matches);
  // The sheet follows the finger that pulls its edge; the canvas takes its new size when it is let go.
  const grip = root.querySelector('.rxf-grip'), reach = () => innerHeight - grip.getBoundingClientRect().bottom;
  let pulled = false;
  drag(grip, '*', (_, {clientY: from, pointerId}) => {
    const before = reach();
    let height = null;
    pulled = false;
    return beside() ? null : {
      move({clientY}) {
        if (height === null && Math.abs(clientY - from) < 6) return;
        if (height === null) {
          page.style.setProperty('--rx-under', `${before}px`);
          grip.setPointerCapture(pointerId);
        }
        height = clamp(before + from - clientY, 0, 0.62 * innerHeight);
        page.style.setProperty('--rx-pulled', `${height}px`);
        if (!page.matches('[data-drawer]')) page.dataset.rail = 'open';
      },
      end({type}) {
        page.style.removeProperty('--rx-under');
        pulled = height !== null && type === 'pointerup';
        if (!pulled) return;
        if (height < 90) page.style.removeProperty('--rx-pulled');
        if (height < 90 && state.bar?.drawer) RX.send('drawer', '');
        openRail(height >= 90);
      },
    };
  });
  // It ends a pull and is no press.
  grip.addEventListener('click', event => { if (pulled && event.detail) event.stopPropagation(); });

  function mark(mode) {
    for (const button of root.querySelectorAll('.rxf-modes button'))
      button.setAttribute('aria-current', String(button.dataset.value === mode));
    if (page.dataset.mode === mode) return;
    page.dataset.mode = mode;
    const panel = document.querySelector('[data-dock-region=right] .mantine-ScrollArea-viewport');
    if (panel) panel.scrollTop = 0;
  }

  RX.paint('bar', bar => {
    const menu = root.querySelector('.rxf-rotor'), tool = name => root.querySelector(`.rxf-tools [data-do=${name}]`);
    write(menu, bar.rotors.map(([name, title]) => `<option value="${text(name)}">${text(title)}</option>`).join(''));
    if (document.activeElement !== menu || menu.value !== bar.rotor) menu.value = bar.rotor;
    mark(bar.mode);
    for (const name of ['undo', 'redo']) tool(name).disabled = !bar[name];
    const pin = tool('pin');
    pin.toggleAttribute('data-on', Boolean(bar.pinned));
    pin.querySelector('span').textContent = bar.pinned ? 'A pinned ▾' : 'Pin A';
    pin.ariaLabel = bar.pinned ? `A is ${bar.pinned.title}` : 'Pin A';
    placeDrawer(bar.drawer);
    sayOpen();
    for (const button of root.querySelectorAll('.rxf-tools [data-do=drawer]'))
      button.ariaExpanded = String(button.dataset.value === bar.drawer);
    if (!part('menu').hidden && bar.pinned) pinMenu(pin, true);
  });

  // A drawer stands beside the stage. The section that a press on the disk opens lies over the cards at the left, or
  // over the open rail of a narrow window, so that the disk stays under the pointer; not over the pressed place itself.
  let drawer = '';
  function placeDrawer(name) {
    if (name === drawer) return;
    drawer = name;
    if (!name) { delete page.dataset.drawer; return; }
    const width = parseFloat(getComputedStyle(page).getPropertyValue('--rx-drawer'));
    const covers = innerWidth <= 1100 && page.dataset.rail === 'open' ? 'rail' : 'cards';
    const free = onDisk !== null && (covers === 'rail' ? onDisk < innerWidth - width : onDisk > width);
    page.dataset.drawer = name === 'probe' && free ? covers : 'beside';
  }

  function pinMenu(button, keep) {
    const menu = part('menu'), pinned = state.bar?.pinned;
    if (!pinned || !keep && !menu.hidden) { menu.hidden = true; return; }
    menu.innerHTML = `<p data-explorer="pinned"><b style="color:var(--rx-pinned)">A</b> ${text(pinned.title)}<br>
      <span class="rxf-dim rxf-num">${text(pinned.power)}</span></p>
      <button data-do="swap">Swap A and B</button><button data-do="back">Back to A</button>
      <label><input type="checkbox" data-do="along" ${pinned.along ? 'checked' : ''}>Fly A at the current condition
      </label>      <button data-do="pin">Unpin</button>`;
    const {left, bottom} = button.getBoundingClientRect();
    if (bottom) menu.style.cssText = `top: ${bottom + 6}px; left: ${clamp(left, 8, innerWidth - 300)}px`;
    if (menu.hidden) { menu.hidden = false; menu.querySelector('button').focus(); }
  }

  RX.paint('views', views => {
    const button = ([name, title]) =>
      `<button data-do="view" data-value="${name}" aria-pressed="${name === views.now}">${text(title)}</button>`;
    page.toggleAttribute('data-undrawn', Boolean(views.missing));
    write(part('views'), views.missing
      ? `<p>${text(views.missing)}</p><button data-page="load">Load again</button>` : views.all.map(button).join(''));
  });
  RX.paint('notice', notice => {
    const bar = part('notice');
    bar.hidden = !page.toggleAttribute('data-notice', Boolean(notice));
    if (!notice) return;
    // Its buttons stay the same ones while its words change with every design tried: a press must not meet a new one.
    write(bar, '<span data-explorer="notice"></span>'
      + notice.actions.map(([name, title]) => `<button data-do="${name}">${text(title)}</button>`).join(''));
    bar.querySelector('span').textContent = notice.text;
  });
  RX.paint('prompt', words => {
    part('prompt').hidden = !words;
    if (words) part('prompt').innerHTML = `${icon('hand')}<span data-explorer="prompt">${text(words.text)}</span>`;
  });
  // Which fractions of the canvas cards cover along its edges, so that the camera shows its subject beside them.
  let telling = 0;
  function tellCover() {  // Below the veil at once, so that the camera stands when it lifts.
    telling ||= setTimeout(measureCover, page.classList.contains('rx-veiled') ? 0 : 120);
  }
  const COVERING = [
    '.rxf-inset', '.rxf-field', '.rxf-fly', '.rxf-earns', '.rxf-open', '.rxf-views', '.rxs-figures',
  ];
  const BETWEEN = 4, EDGE = 18;  // [px] From a card and from the edge, which words round the rim need, to the subject.
  // Width over height of what is looked at: rim and helicopter; the lifted blade with the helicopter behind it. And the
  // rim as an ellipse in the box of the aircraft: the upper corners of the box are free.
  const SHAPE = {aircraft: 2.15, blade: 2.85}, RIM = {centre: .32, wide: .45, high: .33};
  function measureCover() {
    telling = 0;
    const stage = root.querySelector('.rxf-stage').getBoundingClientRect();
    if (!stage.height) return;
    placeBelow();  // New words of the power may have made its card higher since the last frame.
    const cards = cardsOnStage(stage);
    const shape = page.hasAttribute('data-flight') ? SHAPE.blade : SHAPE.aircraft;
    const {left, right, top, bottom} = largestFree(cards, stage.width, stage.height, shape);
    const [above, below] = [top / stage.height, 1 - bottom / stage.height];
    RX.send('covered', RX.covered = [above, below, left / stage.width, 1 - right / stage.width]);
  }
  // The cards as boxes of the stage [px]. The card of power grows with its sentence: it counts with its usual height,
  // and what stands below it as if it had that, or the scene would move with every change.
  function cardsOnStage(stage) {
    const boxes = name => [...root.querySelectorAll(name)].flatMap(card => [...card.getClientRects()]);
    const names = small.matches ? ['.rxf-power', '.rxf-views', '.rxf-notice', '.rxs-figures'] : COVERING;
    const cards = names.flatMap(boxes);
    cards.push(...boxes('.rxs-wipe > span'));
    const [told] = small.matches ? [] : boxes('.rxf-power');
    const usual = usualPower(stage), grown = told ? told.bottom - stage.top - usual : 0;
    const onStage = ({left, right, top, bottom}, up = 0) => ({
      left: left - stage.left - BETWEEN, right: right - stage.left + BETWEEN,
      top: top - stage.top - up, bottom: bottom - stage.top - up,
    });
    const placed = cards.map(card => onStage(card));
    placed.push(...(small.matches ? [] : boxes('.rxf-notice').map(notice => onStage(notice, grown))));
    if (told) placed.push({...onStage(told), top: 0, bottom: usual});
    return placed;
  }
  // How high the card of power usually reaches [px]: the row of the actuator, in one to three lines, and its scale.
  function usualPower({width, height}) {
    if (page.hasAttribute('data-flight') && height > 760 && width > 900) return 198;
    if (page.hasAttribute('data-flight') && !small.matches && width <= 560) return 106;  // Below the views.
    if (page.hasAttribute('data-flight') && width > 960) return 42;
    if (page.hasAttribute('data-flight')) return width > 640 ? 58 : 78;
    if (small.matches) return state.vibration ? 70 : 40;
    const why = width > 860 || height > 560 ? 54 : 0;
    return (state.vibration ? 98 : 66) + why;
  }
  // Whether a card lies on the subject in this box.
  function meets(card, box) {
    const apart = card.left >= box.right - 1 || card.right <= box.left + 1
      || card.top >= box.bottom - 1 || card.bottom <= box.top + 1;
    if (apart) return false;
    if (page.hasAttribute('data-flight')) return true;
    const width = box.right - box.left, height = box.bottom - box.top;
    const x = (box.left + box.right) / 2, y = box.top + RIM.centre * height;
    if (card.bottom > y) return true;
    const across = Math.max(card.left - x, x - card.right, 0) / (RIM.wide * width);
    return Math.hypot(across, (y - card.bottom) / (RIM.high * height)) < 1;
  }
  // The free rectangle in which a subject of this width over height is largest; all of the stage where none is free.
  function largestFree(cards, width, height, shape) {
    const within = (value, most) => value > 0 && value < most;
    const lefts = [EDGE, ...cards.map(card => card.right).filter(x => within(x, width))];
    const rights = [width - EDGE, ...cards.map(card => card.left).filter(x => within(x, width))];
    const tops = [0, ...cards.map(card => card.bottom).filter(y => within(y, height))];
    const bottoms = [height, ...cards.map(card => card.top).filter(y => within(y, height))];
    let best = {left: 0, right: width, top: 0, bottom: height}, most = 0;
    for (const left of lefts) for (const right of rights) for (const top of tops) for (const bottom of bottoms) {
      const size = Math.min(right - left, shape * (bottom - top));
      if (size <= most + 1) continue;
      const free = [.5, 0, 1].map(share => lerp(left, right - size, share))
        .map(from => ({left: from, right: from + size, top, bottom}))
        .find(box => !cards.some(card => meets(card, box)));
      if (free) [best, most] = [free, size];
    }
    return best;
  }
  RX.paint('vibration', tellCover);
  for (const name of [...COVERING, '.rxf-notice']) new ResizeObserver(tellCover).observe(root.querySelector(name));
  // The card of power grows with its words: what stands below it follows.
  const power = root.querySelector('.rxf-power');
  function placeBelow() {
    if (power.offsetHeight) root.style.setProperty('--rx-power', `${power.offsetTop + power.offsetHeight}px`);
  }
  new ResizeObserver(() => {
    placeBelow();
    if (small.matches) tellCover();  // There it is as high as its mode wants, whatever it says.
  }).observe(power);
  // Drawn for their size; the plan hides them.
  for (const name of /** @type {const} */ (['inset', 'strip']))
    new ResizeObserver(() => RX.again(name)).observe(part(name));

  // Words at points of the scene; each of these parts of the state is a list of them.
  const LABELS = /** @type {const} */ (['lifted_labels', 'probe_label', 'hub_labels']), LABEL_SHIFT = 60;  // [px]
  let labels = [];
  for (const name of LABELS) RX.paint(name, () => {
    labels = LABELS.flatMap(list => state[list] ?? []);
    const all = part('labels');  // They stay where they are, and new ones are unseen, until they are placed.
    while (all.children.length > labels.length) all.lastChild?.remove();
    while (all.children.length < labels.length)
      all.insertAdjacentHTML('beforeend', '<span class="rxf-label rxf-num" style="visibility:hidden"></span>');
    labels.forEach((label, k) => {
      Object.assign(all.children[k], {textContent: label.text, title: label.title ?? ''});
      all.children[k].dataset.kind = label.kind ?? '';
    });
  });
  function placeLabels(canvas) {
    const taken = [], cards = [...root.querySelectorAll(':is(.rxf-stage, .rxf-low) > .rxf-card')]
      .map(card => card.getBoundingClientRect()).filter(card => card.width)
      .map(card => [card.left - canvas.left, card.top - canvas.top, card.width, card.height]);
    const place = (label, element) => {
      const of = node(label.node);
      for (let above = of; above; above = above.parent) if (!above.visible) return false;
      if (!of || !viewer().camera) return false;
      const point = project(of, label.at), {offsetWidth: width, offsetHeight: height} = element;
      const left = clamp(point.left - width / 2, 4, canvas.width - width - 4);
      // What is named at the lifted blade stands below its point: the helicopter is above.
      const hangs = label.kind === 'lifted', wanted = hangs ? point.top : Math.max(4, point.top - height);
      // None lies behind a card or over another: it goes above or below what it meets, but not far from its point, and
      // rather not over what it names.
      const others = [...taken, ...cards];
      const cost = top => (top > wanted) === hangs ? Math.abs(top - wanted) : 2 * Math.abs(top - wanted);
      const met = top => others
        .some(([x, y, w, h]) => left < x + w && x < left + width && top < y + h && y < top + height);
      const tops = [wanted, ...others.flatMap(([, y,, h]) => [y - height - 2, y + h + 2])]
        .filter(top => top >= 4 && cost(top) < LABEL_SHIFT && !met(top)).sort((one, two) => cost(one) - cost(two));
      const top = tops[0] ?? wanted;
      element.style.setProperty('--rx-lead', `${Math.max(hangs ? top - wanted : wanted - top, 0)}px`);
      element.style.setProperty('--rx-lead-at', `${point.left - left}px`);
      element.style.transform = `translate(${left.toFixed(1)}px, ${top.toFixed(1)}px)`;
      const free = point.seen && top + height < canvas.height && tops.length > 0;
      if (free) taken.push([left, top, width, height]);
      return free;
    };
    [...part('labels').children].forEach((element, k) => {
      element.style.visibility = place(labels[k], element) ? 'visible' : 'hidden';
    });
  }

  // Where the canvas is: cards follow it; and the prompt follows a node of the scene.
  let hooked = null;
  function look() {
    requestAnimationFrame(look);
    const {canvas, scene} = viewer() ?? {};
    if (!canvas) return;
    if (follow(canvas)) {
      RX.again('inset', 'strip', 'twist');
      tellCover();
    }
    // What belongs to a point of a turning blade is placed once more when the blade is drawn: else it is a frame late.
    if (scene && scene !== hooked) {
      const after = scene.onAfterRender;
      hooked = scene;
      scene.onAfterRender = (...all) => { after.apply(scene, all); placeWords(); };
    }
    placeWords();
  }
  function placeWords() {
    const box = viewer().canvas.getBoundingClientRect(), prompt = part('prompt');
    if (labels.length) placeLabels(box);
    const of = state.prompt && node(state.prompt.node);
    if (!state.prompt || !of || !viewer().camera) return;
    const point = project(of, state.prompt.at), width = prompt.offsetWidth;
    const left = clamp(point.left - 0.8 * width, 8, box.width - width - 8);
    const rim = rimOfDisk().filter(on => on.left > left && on.left < left + width).map(on => on.top + 12);
    const top = clamp(Math.max(point.top + 20, ...rim), 8, box.height - 60);
    prompt.style.setProperty('--rx-lead', `${Math.max(top - point.top, 0)}px`);
    prompt.style.setProperty('--rx-lead-at', `${point.left - left}px`);
    prompt.style.transform = `translate(${left}px, ${top}px)`;
  }
  // Points of the rim of the disk on the canvas; none where there is no disk.
  function rimOfDisk() {
    const mesh = node('/rotor/disk/field')?.getObjectByProperty('isMesh', true);
    if (!mesh) return [];
    if (!mesh.geometry.boundingBox) mesh.geometry.computeBoundingBox();
    const {min, max} = mesh.geometry.boundingBox, [x, y, z] = ['x', 'y', 'z'].map(axis => (min[axis] + max[axis]) / 2);
    return Array.from({length: 48}, (_, k) => 2 * Math.PI * k / 48).map(turn =>
      project(mesh, [x + (max.x - x) * Math.cos(turn), y + (max.y - y) * Math.sin(turn), z]));
  }
  requestAnimationFrame(look);
  // viser's notifications lie in the top layer: its own lies below our cards. Its remark on drawing in software is said
  // for a while, and then makes room.
  new MutationObserver(() => {
    for (const note of document.querySelectorAll('.mantine-Notification-root:not([data-seen])')) {
      note.dataset.seen = '';
      const all = closest({target: note}, '[class*=Notifications-root]');
      if (all && !all.popover) { all.popover = 'manual'; all.showPopover?.(); }
      if (/Software WebGL/.test(note.textContent)) setTimeout(() => note.querySelector('button')?.click(), 5000);
    }
  }).observe(document.body, {childList: true, subtree: true});
  // What viser mounts anew is filled anew.
  new MutationObserver(() => { RX.again('twist', 'worth'); Charts.find(); })
    .observe(document.getElementById('root') ?? document.body, {childList: true, subtree: true});
})();
