// The lecture as a column of steps beside the scene: a guess, its answer with a chart, one control. The page and the file
// without a server both use it: everything reports by `data-do`, and what is shown comes through `steps` and `now`.
window.makeStory = (column, figures, report) => {
  const {text} = Charts;
  const marked = value => text(value).replace(/\*\*(.+?)\*\*/g, '<b>$1</b>').replace(/\*(.+?)\*/g, '<em>$1</em>');
  const calm = matchMedia('(prefers-reduced-motion: reduce)');
  let steps = [], now = null, drawn = '', sweep = 0;
  const list = column.querySelector('.rxs-list'), foot = column.querySelector('.rxs-foot');
  const section = k => list.children[k];

  const draw = () => {
    const names = JSON.stringify(steps.map(step => step.name));
    if (names !== drawn) {
      drawn = names;
      list.innerHTML = steps.map((step, k) => `<section data-step="${k + 1}" aria-label="${text(step.title)}">
        <p class="rxs-count">Step ${k + 1} of ${steps.length}</p><h2>${text(step.title)}</h2><p class="rxs-watch"></p>
        <dl class="rxs-pair" hidden><dt data-side="a">A</dt><dd></dd><dt data-side="b">B</dt><dd></dd></dl>
        <fieldset class="rxs-guess"><legend></legend><div>${step.options.map((_, n) => `<button data-do="guess" data-value="${n}"></button>`).join('')}</div></fieldset>
        <div class="rxs-answer" aria-live="polite" hidden><p></p><figure></figure></div>
        <div class="rxs-control"></div></section>`).join('');
      foot.querySelector('.rxs-dots').innerHTML = steps.map((step, k) => `<button data-do="story" data-value="${k}" aria-label="${text(`Step ${k + 1}: ${step.title}`)}" title="${text(step.title)}"></button>`).join('');
    }
    steps.forEach((step, k) => {
      const part = section(k), set = (place, html) => { if (place.innerHTML !== html) place.innerHTML = html; };
      set(part.querySelector('.rxs-watch'), marked(step.watch));
      set(part.querySelector('legend'), marked(step.question));
      step.options.forEach((option, n) => set(part.querySelectorAll('.rxs-guess button')[n], text(option)));
      const pair = part.querySelector('.rxs-pair');
      pair.hidden = !step.a;
      set(pair.children[1], text(step.a));
      set(pair.children[3], text(step.b));
      control(step, part.querySelector('.rxs-control'));
    });
  };

  const control = (step, place) => {
    const {label, kind, words} = step.control, last = words.length - 1;
    if (place.dataset.count !== String(words.length)) {
      place.dataset.count = words.length;
      const bar = kind === 'switch'
        ? `<div class="rxs-switch" role="group" aria-label="${text(label)}">${words.map((word, k) => `<button data-do="stop" data-value="${k}">${text(word)}</button>`).join('')}</div>`
        : `<button data-sweep aria-label="Play: move ${text(label)} from end to end" title="Move it from end to end"></button><input type="range" min="0" max="${Math.max(last, 0)}" step="1" data-stop aria-label="${text(label)}">`;
      place.innerHTML = `<p><b>${text(label)}</b><output class="rxf-num"></output></p><div class="rxs-bar">${bar}</div><p class="rxs-todo"></p>`;
    }
    const todo = step.todo.replace(`**${label}**: `, '');
    const say = place.querySelector('.rxs-todo'), words_ = marked(todo.charAt(0).toUpperCase() + todo.slice(1));
    if (say.innerHTML !== words_) say.innerHTML = words_;
  };

  const show = () => {
    if (!now || !steps.length) return;
    const {at, guess, answer, stop, held} = now;
    column.dataset.step = at + 1;
    [...list.children].forEach((one, k) => {
      one.inert = k !== at;
      const own = k === at ? now : {guess: null, answer: null, stop: null};
      for (const button of one.querySelectorAll('.rxs-guess button')) {
        const n = Number(button.dataset.value);
        button.disabled = held || own.guess !== null;
        button.toggleAttribute('data-chosen', own.guess === n);
        button.toggleAttribute('data-right', Boolean(own.answer) && own.answer.right === n);
      }
    });
    const part = section(at), place = part.querySelector('.rxs-answer'), step = steps[at];
    for (const other of list.querySelectorAll('.rxs-answer')) other.hidden = other !== place || guess === null;
    if (guess !== null) {
      const right = answer && answer.right === guess;
      place.querySelector('p').innerHTML = answer ? `<b class="rxs-verdict" data-right="${right}">${right ? 'Right.' : 'Not so.'}</b> ${marked(answer.answer)}` : text(now.problem || 'Computing …');
      plot(place.querySelector('figure'), answer, stop);
    }
    const out = part.querySelector('output'), slider = part.querySelector('[data-stop]');
    out.textContent = step.control.words.length ? step.control.words[stop] ?? '' : now.problem || 'computing …';
    if (slider) {
      if (document.activeElement !== slider || !slider.matches(':active')) slider.value = stop ?? 0;
      slider.disabled = held || !step.control.words.length;
      slider.ariaValueText = out.textContent;
      const play = part.querySelector('[data-sweep]');
      play.disabled = slider.disabled;
      play.dataset.on = Boolean(sweep);
    }
    for (const button of part.querySelectorAll('[data-do=stop]')) {
      button.ariaPressed = String(Number(button.dataset.value) === stop);
      button.disabled = held;
    }
    foot.querySelectorAll('.rxs-dots button').forEach((dot, k) => { dot.ariaCurrent = k === at ? 'step' : 'false'; dot.disabled = held; });
    for (const button of foot.querySelectorAll('[data-do=lecture]')) button.hidden = held;
    foot.querySelector('[data-held]').hidden = !held;
    foot.querySelector('[data-value=back]').disabled = at === 0;
    foot.querySelector('[data-value=next]').textContent = step.last ? now.finish : 'Next';
    figures.hidden = false;
    const numbers = now.figures.map(([title, value]) => `<div><b class="rxf-num"${value === '?' ? ' data-unknown' : ''}>${text(value)}</b><span>${text(title)}</span></div>`).join('');
    if (figures.innerHTML !== numbers) figures.innerHTML = numbers;
    keep();
  };

  // Lines over what is moved, with the present place on each.
  const plot = (figure, answer, stop) => {
    if (!answer) { figure.innerHTML = ''; return; }
    const dots = (answer.dots[stop] ?? []).map(([x, y, colour]) => ({kind: 'points', x: [x], y: [y], colour, size: 6}));
    const height = innerHeight < 800 ? 118 : innerHeight < 1000 ? 146 : 190, width = Math.max(figure.clientWidth, 260);
    Charts.fill(figure, {...answer.chart, series: [...answer.chart.series, ...dots]}, {width, height});
  };

  // The step that stands keeps its place in the column, scrolled by `within`, whatever is laid out anew. Another is asked
  // for only where the hand scrolled to it: what the browser scrolls by itself, for a layout or the focus, asks for none.
  let hand = false, aiming = false, within = 0, settle = 0;
  const seen = () => [...list.children].findIndex(part => part.offsetTop + part.offsetHeight - list.scrollTop > 0.5 * list.clientHeight);
  const rest = () => { clearTimeout(settle); settle = setTimeout(settled, 140); };
  const keep = () => { if (!hand && !aiming) list.scrollTop = section(now.at).offsetTop + within; };
  const go = behavior => {
    if (!steps.length) return;
    hand = false;
    aiming = true;
    within = 0;
    list.scrollTo({top: section(now.at).offsetTop, behavior: calm.matches ? 'instant' : behavior});
    rest();
  };
  const settled = () => {
    aiming = false;
    if (!now || !steps.length) return;
    const at = seen();
    if (hand && !now.held && at >= 0 && at !== now.at) report('story', at);
    else { hand = false; keep(); }
  };
  list.addEventListener('scroll', () => {
    if (now && !aiming && seen() === now.at) within = list.scrollTop - section(now.at).offsetTop;
    rest();
  });
  const byHand = event => { if (event.type === 'wheel' || event.type === 'touchmove' || event.target === list) { hand = true; aiming = false; } };
  for (const name of ['wheel', 'touchmove', 'pointerdown', 'keydown']) list.addEventListener(name, byHand, {passive: true});

  // The control: a slider reports its position once a frame at most; play walks it to the end and back to where it was.
  let moved = null;
  const move = stop => {
    moved ??= requestAnimationFrame(() => { report('stop', moved === null ? stop : latest); moved = null; });
    latest = stop;
  };
  let latest = 0;
  const halt = () => { clearInterval(sweep); sweep = 0; };
  column.addEventListener('input', event => {
    if (!event.target.matches('[data-stop]')) return;
    event.stopPropagation();
    halt();
    move(Number(event.target.value));
  });
  column.addEventListener('click', event => {
    const near_ = event.target.closest('button');
    if (!near_ || near_.disabled) return;
    if (!('sweep' in near_.dataset)) { halt(); return; }
    if (sweep) { halt(); show(); return; }
    const last = steps[now.at].control.words.length - 1, from = now.stop;
    let k = from >= last ? 0 : from;
    sweep = setInterval(() => {
      const busy = now.busy;
      if (busy) return;
      k += 1;
      if (k > last) { halt(); move(from); show(); } else move(k);
    }, 420);
    show();
  });
  new ResizeObserver(() => {
    if (now && steps.length) within = Math.max(0, Math.min(within, section(now.at).offsetHeight - list.clientHeight));
    hand = aiming = false;
    show();
  }).observe(column);

  return {
    steps(next) { steps = next; draw(); show(); },
    show(next) {
      const first = !now, other = first || next.at !== now.at;
      if (other) { halt(); aiming = true; }
      now = next;
      show();
      if (other) go(first ? 'instant' : 'smooth');
    },
    end() { halt(); now = null; figures.hidden = true; },
  };
};
