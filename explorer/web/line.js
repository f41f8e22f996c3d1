// @ts-check
// The line on top: what is said of the design, and its numbers, which are dragged as their sliders are.
(() => {
  const {text, clamp, write, staleMark, outdate, closest, paced, drag} = Common, {part} = RX, place = part('line');
  const SPAN = 480;  // [px] from one end of a slider to the other, if its steps are not too fine for that.
  // Parts that say of what; the others are its answer.
  const NAMES = ['wide', 'models', 'state', 'forbidden', 'problem'];
  const LATER = 900;  // [ms] from the last move to the spoken line.
  /** @type {Map<string, RxLineControl>} */
  const controls = new Map();
  let told = 0;

  RX.paint('line', line => {
    const {pieces, status, problem} = line, focused = closest({target: document.activeElement}, '[data-slide]');
    controls.clear();
    const words = pieces.map(({text: said, part: name, kind, stale, title, control}) => {
      if (control) controls.set(control.name, control);
      const slides = control && `role="slider" tabindex="0" data-slide="${control.name}"
        aria-label="${text(control.label)}" aria-valuemin="${control.low}" aria-valuemax="${control.high}"
        aria-valuenow="${control.value}" aria-valuetext="${text(control.words)}"
        title="${text(control.label)}: drag, or arrow keys"`;
      const answers = NAMES.includes(name) ? '' : 'data-answers';
      const marks = name && `data-explorer="${name}" class="${kind && `rxf-${kind}`}" ${answers}${staleMark(stale)}
        ${title && `title="${text(title)}"`}`;
      return slides || marks ? `<span ${slides || marks}>${text(said)}</span>` : text(said);
    }).join('');
    write(place, `${words}${problem
      ? ' <button data-do="nearest" data-explorer="nearest">Nearest that trims</button>' : ''} <button
      class="rxf-chip" data-answers data-do="drawer" data-value="trust" data-explorer="status"
      title="${text(status.title)}"
      data-kind="${status.kind === 'care' ? 'converged' : status.kind}" data-tone="${status.kind}"
      ${status.words ? '' : 'hidden'}>${text(status.words)}</button>`);
    place.toggleAttribute('data-problem', Boolean(problem));
    document.documentElement.toggleAttribute('data-refused', Boolean(problem));
    if (focused && !focused.isConnected) {
      const again = place.querySelector(`[data-slide="${focused.dataset.slide}"]`);
      (again ?? place.querySelector('[data-slide]'))?.focus({preventScroll: true});
    }
    clearTimeout(told);
    told = setTimeout(() => RX.say(spoken()), problem ? 0 : LATER);  // Once no answer follows.
  });

  // What is not yet of these inputs is said with its mark.
  const spoken = () => [...place.childNodes].map(node => node instanceof Element && node.hasAttribute('data-stale')
    ? `${node.textContent} (${node.getAttribute('aria-description')})` : node.textContent).join('');

  // From the change of an input to its answer, the page as a whole has the mark; without a trim it keeps it.
  RX.paint(['line', 'stale'], ({problem}, stale) => outdate(document.documentElement, stale || problem));

  // It moves at once; what is said of the design before is grey until the answer comes.
  const sliding = paced((/** @type {[string, number]} */ to) => RX.send('slide', to));
  function slide(name, wanted) {
    const control = controls.get(name), element = place.querySelector(`[data-slide="${name}"]`);
    if (!control || !element) return;
    const steps = Math.round(wanted / control.step), value = clamp(steps * control.step, control.low, control.high);
    if (value === control.value) return;
    control.value = value;
    const digits = Math.max(0, -Math.floor(Math.log10(control.step) + 1e-9));
    element.textContent = element.textContent.startsWith('+') || /^[a-z]/.test(element.textContent)
      ? Common.signed(value, digits) : Common.fixed(value, digits);
    outdate(document.documentElement, true);
    place.written = '';
    sliding.send([name, value]);
    clearTimeout(told);
  }
  drag(place, '[data-slide]', (element, {clientX}) => {
    const {slide: name} = element.dataset, control = controls.get(name);
    if (!control) return null;
    const {value, low, high, step} = control, letGo = RX.hold(), near = SPAN * step / (high - low);
    const pixels = step / clamp(near, 2, 8);
    element.focus();
    return {
      move(event) { slide(name, value + pixels * (event.clientX - clientX)); },
      end() { sliding.flush(); letGo(); },
    };
  });
  place.addEventListener('keydown', event => {
    const {slide: name} = closest(event, '[data-slide]')?.dataset ?? {};
    const control = controls.get(name);
    if (!control) return;
    const {value, low, high, step} = control, up = value + step, down = value - step;
    const to = {ArrowUp: up, ArrowRight: up, ArrowDown: down, ArrowLeft: down, Home: low, End: high}[event.key];
    if (to === undefined) return;
    event.preventDefault();
    event.stopPropagation();
    slide(name, to);
  });
  // Its height is its own: what stands below begins there.
  const {style} = document.documentElement;
  new ResizeObserver(() => style.setProperty('--rx-said', `${place.offsetHeight}px`)).observe(place);
})();
