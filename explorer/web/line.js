// @ts-check
// The line on top: what is said of the design. Its numbers are dragged as their sliders are; a press on one of them, or
// on a word with a menu, opens the values that it can take below it.
(() => {
  const {text, clamp, write, staleMark, outdate, closest, paced, drag} = Common, {part} = RX;
  const place = part('line'), values = part('values');
  const SPAN = 480;  // [px] from one end of a slider to the other, if its steps are not too fine for that.
  const SLACK = {mouse: 3, pen: 5, touch: 8};  // [px] by which a press may move and is no drag.
  // Parts that say of what; the others are its answer.
  const NAMES = ['wide', 'airspeed', 'models', 'state', 'forbidden', 'problem'];
  const LATER = 900;  // [ms] from the last move to the spoken line.
  /** @type {Map<string, RxLineControl>} */
  const controls = new Map();
  /** @type {Map<string, RxLineMenu>} */
  const menus = new Map();
  let told = 0;

  const handle = name => name ? place.querySelector(`[data-handle="${name}"]`) : null;
  // A number of a control as the line has it, and with its unit.
  function shown(control, at = control.value) {
    const value = control.factor * at, {digits} = control;
    const said = control.signed ? Common.signed(value, digits) : Common.fixed(value, digits);
    return said.replace(/\d(?=(\d{3})+(\.|$))/g, '$&\u2009');
  }
  const inWords = (control, at) => `${shown(control, at)} ${control.unit}`.trim();

  function sliderMarks(control) {
    return `role="slider" tabindex="0" data-handle="${control.name}" data-slide="${control.name}"
      aria-label="${text(control.label)}" aria-haspopup="dialog" aria-valuemin="${control.factor * control.low}"
      aria-valuemax="${control.factor * control.high}" aria-valuenow="${control.factor * control.value}"
      aria-valuetext="${text(control.words)}"
      title="${text(control.label)}: drag, arrow keys, or press for its slider"`;
  }
  function menuMarks(menu) {
    return `role="button" tabindex="0" data-handle="${menu.name}" aria-haspopup="listbox"
      aria-expanded="${opened?.name === menu.name}" title="${text(menu.label)}: press to choose"`;
  }

  // The band of the power leads to how far to trust it.
  const TRUST = 'role="button" tabindex="0" data-do="drawer" data-value="trust"';
  const BAND = 'span[data-value=trust]', WORDS = `[data-handle], ${BAND}`;  // That can be pressed.

  function draw(line) {
    const {pieces, status, problem} = line;
    const focused = closest({target: document.activeElement}, WORDS);
    controls.clear();
    menus.clear();
    const words = pieces.map(({text: said, part: name, kind, stale, title, control, menu}) => {
      if (control) controls.set(control.name, {...control});  // It moves before the answer comes.
      if (menu) menus.set(menu.name, menu);
      const opens = control ? sliderMarks(control) : menu ? menuMarks(menu) : name === 'within' ? TRUST : '';
      const answers = NAMES.includes(name) ? '' : 'data-answers';
      const marks = name && `data-explorer="${name}" class="${kind && `rxf-${kind}`}" ${answers}${staleMark(stale)}
        ${title && `title="${text(name === 'within' ? `${title} ${status.title}` : title)}"`}`;
      return opens || marks ? `<span ${marks} ${opens}>${text(said)}</span>` : text(said);
    }).join('');
    write(place, `${words}${problem
      ? ' <button data-do="nearest" data-explorer="nearest">Nearest that trims</button>' : ''} <button
      class="rxf-chip" data-answers data-do="drawer" data-value="trust" data-explorer="status"
      title="${text(status.title)}"
      data-kind="${status.kind === 'care' ? 'converged' : status.kind}" data-tone="${status.kind}"
      ${status.words ? '' : 'hidden'}>${text(status.words)}</button>`);
    place.toggleAttribute('data-problem', Boolean(problem));
    document.documentElement.toggleAttribute('data-refused', Boolean(problem));
    if (focused && !focused.isConnected)
      (focused.dataset.value ? place.querySelector(BAND)
        : handle(focused.dataset.handle) ?? handle('advance_ratio'))?.focus({preventScroll: true});
    follow();
    clearTimeout(told);
    told = setTimeout(() => RX.say(spoken()), problem ? 0 : LATER);  // Once no answer follows.
  }
  RX.paint('line', draw);

  // What is not yet of these inputs is said with its mark.
  const spoken = () => [...place.childNodes].map(node => node instanceof Element && node.hasAttribute('data-stale')
    ? `${node.textContent} (${node.getAttribute('aria-description')})` : node.textContent).join('');

  // From the change of an input to its answer, the page as a whole has the mark; without a trim it keeps it.
  RX.paint(['line', 'stale'], (line, stale) => {
    outdate(document.documentElement, stale || line.problem);
    // What was moved and taken back before an answer has no other line.
    if (!stale && place.written === '') draw(line);
  });

  // It moves at once; what is said of the design before is grey until the answer comes.
  const sliding = paced((/** @type {[string, number]} */ to) => RX.send('slide', to));
  function slide(control, wanted) {
    const steps = Math.round(wanted / control.step), value = clamp(steps * control.step, control.low, control.high);
    if (value === control.value) return;
    for (const one of new Set([...controls.values(), control])) {
      if (one.slider !== control.slider) continue;
      one.value = value;
      const element = handle(one.name);
      if (element) element.textContent = shown(one);
    }
    outdate(document.documentElement, true);
    place.written = '';
    sliding.send([control.slider, value]);
    clearTimeout(told);
  }

  // Rows are closer than a finger is wide: where two words can be pressed, the nearer one is meant.
  function nearest({clientX: x, clientY: y}) {
    const away = element => {
      const {left, right, top, bottom} = element.getBoundingClientRect();
      return Math.max(left - x, 0, x - right) + Math.abs(y - (top + bottom) / 2);
    };
    return [...place.querySelectorAll(WORDS)].filter(element => element.checkVisibility())
      .reduce((one, other) => away(other) < away(one) ? other : one);
  }
  // A press that hardly moves opens the values, or closes them. Any other is a drag, also where they are open.
  drag(place, WORDS, (_, event) => {
    const {clientX: from, pointerType} = event, pressed = nearest(event);
    const {handle: name} = pressed.dataset, control = controls.get(name);
    const begun = control?.value ?? 0;
    let letGo = null, moved = false;
    pressed.focus({preventScroll: true});
    return {
      move({clientX}) {
        const way = clientX - from;
        moved ||= Math.abs(way) > SLACK[pointerType];
        const now = controls.get(name);
        if (!moved || !control || !now) return;
        letGo ??= RX.hold();
        const {step, low, high} = control, pixels = step / clamp(SPAN * step / (high - low), 2, 8);
        slide(now, begun + pixels * way);
      },
      end({type}) {
        if (letGo) {
          sliding.flush();
          letGo();
        } else if (!moved && type === 'pointerup') {
          if (name) toggle(name); else place.querySelector(BAND)?.click();
        }
      },
    };
  });
  // Where a touch is told as a mouse afterwards, the focus stays in what it has opened.
  place.addEventListener('mousedown', event => { if (closest(event, WORDS)) event.preventDefault(); });
  // What a pointer pressed has had its answer.
  place.addEventListener('click', event => {
    if (event.detail && closest(event, WORDS)) event.stopPropagation();
  }, true);
  // A click without a pointer is that of a screen reader, or of a key on a button.
  place.addEventListener('click', event => {
    const {handle: name} = closest(event, '[data-handle]')?.dataset ?? {};
    if (name && event.detail === 0) toggle(name);
  });
  place.addEventListener('keydown', event => {
    const trusted = closest(event, BAND);
    if (trusted && ['Enter', ' '].includes(event.key)) {
      event.preventDefault();
      trusted.click();
    }
    const {handle: name} = closest(event, '[data-handle]')?.dataset ?? {}, control = controls.get(name);
    if (!name || event.ctrlKey || event.metaKey || event.altKey) return;
    const opens = ['Enter', ' ', ...(control ? [] : ['ArrowDown'])].includes(event.key);
    if (!opens && !(event.key === 'Escape' && opened) && !(control && event.key in placesOf(control))) return;
    event.preventDefault();
    event.stopPropagation();
    if (opens) open(name);
    else if (event.key === 'Escape') close(true);
    else if (control) slide(control, placesOf(control)[event.key]);
  });
  // Where keys move a number.
  function placesOf({value, step, low, high}) {
    const up = value + step, down = value - step;
    return {ArrowUp: up, ArrowRight: up, ArrowDown: down, ArrowLeft: down, Home: low, End: high};
  }

  // What is open: the name of its word; of a number its control, when its own slider moved last, and whether a pointer
  // has it.
  const REST = 400;  // [ms] after which the slider follows the page again: answers to its own moves come late.
  /** @type {{name: string, control?: RxLineControl, moved: number, held: boolean} | null} */
  let opened = null;
  let followed = 0;
  function toggle(name) {
    if (opened?.name === name) close(true); else open(name);
  }
  function open(name) {
    const control = controls.get(name), menu = menus.get(name), word = handle(name);
    if (!word || !control && !menu) return;
    close(false);
    opened = {name, control, moved: -Infinity, held: false};
    if (menu) word.ariaExpanded = 'true';
    values.setAttribute('role', menu ? 'listbox' : 'dialog');
    values.ariaLabel = control?.label ?? menu?.label;
    values.written = null;
    values.innerHTML = control ? `<p><span></span><output class="rxf-num"></output></p><input type="range">
      <p class="rxf-num"><span></span><span></span></p>` : '';
    values.hidden = false;
    values.showPopover?.();
    if (control) showSlider(control); else if (menu) showOptions(menu);
    stand();
    const first = values.querySelector('input, [aria-selected=true]') ?? values.querySelector('button');
    first?.focus({preventScroll: true});
  }
  function close(returns) {
    if (!opened) return;
    const {name} = opened;
    opened = null;
    handle(name)?.removeAttribute('aria-expanded');
    if (menus.has(name) && handle(name)) handle(name).ariaExpanded = 'false';
    if (returns) (handle(name) ?? handle('advance_ratio'))?.focus({preventScroll: true});
    values.hidePopover?.();
    values.hidden = true;
  }
  // With each line: what is open shows what its word now has, whoever moved it, and keeps the focus.
  function follow() {
    if (!opened) return;
    const {name, control, moved} = opened, menu = menus.get(name), found = controls.get(name);
    if (menu) return showOptions(menu);
    const inside = values.contains(document.activeElement);
    if (!control) return close(inside);
    if (found) opened.control = found;
    // In hover there is no airspeed to say; at its usual value a number may have no place in the line.
    else if (moved === -Infinity) return close(inside);
    else control.value = [...controls.values()].find(one => one.slider === control.slider)?.value ?? control.value;
    const wait = opened.held ? REST : moved + REST - performance.now();
    clearTimeout(followed);
    if (wait > 0) followed = setTimeout(follow, wait);
    else showSlider(opened.control);
  }
  function showSlider(control) {
    const [head, ends] = values.querySelectorAll('p'), slider = values.querySelector('input');
    head.firstChild.textContent = control.label;
    head.lastChild.textContent = inWords(control);
    Object.assign(slider, {min: control.low, max: control.high, step: control.step, value: control.value});
    slider.ariaLabel = control.label;
    slider.ariaValueText = inWords(control);
    ends.firstChild.textContent = inWords(control, control.low);
    ends.lastChild.textContent = inWords(control, control.high);
  }
  function showOptions({options}) {
    const at = [...values.children].indexOf(document.activeElement);
    write(values, options.map(({title, chosen}, k) => `<button role="option" tabindex="-1" aria-selected="${chosen}"
      data-option="${k}">${text(title)}</button>`).join(''));
    if (at >= 0) values.children[Math.min(at, options.length - 1)]?.focus({preventScroll: true});
  }
  // Below the word, wholly in the window.
  function stand() {
    const box = handle(opened?.name)?.getClientRects()[0];
    if (!box) return;
    // A finger may press well above and below the letters.
    const below = Math.min(box.bottom, (box.top + box.bottom) / 2 + 18) + 4;
    values.style.top = `${below}px`;
    values.style.maxHeight = `${innerHeight - below - 8}px`;
    values.style.left = `${clamp(box.left - 6, 8, Math.max(innerWidth - values.offsetWidth - 8, 8))}px`;
  }

  values.addEventListener('input', event => {
    event.stopPropagation();
    if (!opened?.control) return;
    const {control} = opened;
    opened.moved = performance.now();
    slide(control, Number(event.target.value));
    values.querySelector('output').textContent = event.target.ariaValueText = inWords(control);
  });
  drag(values, 'input', () => {
    const letGo = RX.hold();
    if (opened) opened.held = true;
    return {
      end() {
        if (opened) opened.held = false;
        sliding.flush();
        letGo();
        follow();
      },
    };
  });
  values.addEventListener('click', event => {
    const option = menus.get(opened?.name ?? '')?.options[closest(event, '[data-option]')?.dataset.option];
    if (!option) return;
    close(true);
    if (option.chosen) return;
    const letGo = RX.hold();  // A step of undo of its own.
    RX.send(/** @type {any} */ (option.press), option.value);
    letGo();
  });
  values.addEventListener('keydown', event => {
    const last = values.children.length - 1, at = [...values.children].indexOf(closest(event, '[data-option]'));
    const ends = ['Escape', ...(opened?.control ? ['Enter'] : [])].includes(event.key);
    const goes = {ArrowDown: Math.min(at + 1, last), ArrowUp: Math.max(at - 1, 0), Home: 0, End: last}[event.key];
    if (event.key !== 'Tab') event.stopPropagation();
    // The page does not hear its own keys in a slider.
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === 'z') {
      event.preventDefault();
      return RX.send(event.shiftKey ? 'redo' : 'undo');
    }
    if (!ends && (at < 0 || goes === undefined)) return;
    event.preventDefault();
    if (ends) close(true);
    else values.children[goes].focus();
  });
  // A press elsewhere closes it, and so does a focus that goes elsewhere.
  addEventListener('pointerdown', event => {
    if (opened && !closest(event, '[data-part=values]') && closest(event, '[data-handle]') !== handle(opened.name))
      close(false);
  }, true);
  values.addEventListener('focusout', ({relatedTarget: next}) => {
    if (next && opened && !values.contains(next) && next !== handle(opened.name)) close(false);
  });
  addEventListener('resize', stand);

  // Its height is its own: what stands below begins there.
  const {style} = document.documentElement;
  new ResizeObserver(() => style.setProperty('--rx-said', `${place.offsetHeight}px`)).observe(place);
})();
