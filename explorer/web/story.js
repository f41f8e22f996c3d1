// @ts-check
// The lecture as a column of steps beside the scene: a guess, its answer with a chart, one control.
// Everything reports by `data-do`, and what is shown comes through `steps` and `show`.
window.makeStory = (column, figures, report) => {
  const {text, clamp, write, calm, closest, soon} = Common;
  const marked = value => text(value).replace(/\*\*(.+?)\*\*/g, '<b>$1</b>').replace(/\*(.+?)\*/g, '<em>$1</em>');
  let steps = [], now = null, sweep = 0;
  const list = column.querySelector('.rxs-list'), foot = column.querySelector('.rxs-foot');
  const section = k => list.children[k];

  const draw = () => {
    write(list, steps.map(({title, options}, k) => `<section data-step="${k + 1}" aria-label="${text(title)}">
      <p class="rxs-count">Step ${k + 1} of ${steps.length}</p><h2>${text(title)}</h2><p class="rxs-watch"></p>
      <dl class="rxs-pair" hidden><dt data-side="a">A</dt><dd></dd><dt data-side="b">B</dt><dd></dd></dl>
      <fieldset class="rxs-guess"><legend></legend>
        <div>${options.map((_, n) => `<button data-do="guess" data-value="${n}"></button>`).join('')}</div></fieldset>
      <div class="rxs-answer" aria-live="polite" hidden><p></p><figure></figure></div>
      <div class="rxs-control"></div></section>`).join(''));
    write(foot.querySelector('.rxs-dots'), steps.map(({title}, k) => `<button data-do="story" data-value="${k}"
      aria-label="Step ${k + 1}: ${text(title)}" title="${text(title)}"></button>`).join(''));
    steps.forEach((step, k) => {
      const part = section(k);
      // A sentence stands once its numbers are there.
      const computed = step.question && step.options.every(Boolean);
      write(part.querySelector('.rxs-watch'), marked(step.watch));
      write(part.querySelector('legend'), computed ? marked(step.question) : 'Computing …');
      step.options.forEach((option, n) => write(part.querySelectorAll('.rxs-guess button')[n], text(option)));
      part.querySelector('.rxs-guess > div').hidden = !computed;
      drawControl(step, part.querySelector('.rxs-control'));
    });
  };

  const drawControl = ({control: {label, kind, words}, todo}, place) => {
    const choices = words.map((word, k) => `<button data-do="stop" data-value="${k}">${text(word)}</button>`).join('');
    const name = text(label), most = Math.max(words.length - 1, 0);
    const bar = kind === 'switch' ? `<div class="rxs-switch" role="group" aria-label="${name}">${choices}</div>`
      : `<button data-sweep aria-label="Play: move ${name} from end to end" title="Move it from end to end"></button>
        <input type="range" min="0" max="${most}" step="1" data-stop aria-label="${name}">`;
    write(place, `<p><b>${name}</b><output class="rxf-num"></output></p><div class="rxs-bar">${bar}</div>
      <p class="rxs-note" role="status" hidden></p><p class="rxs-todo"></p>`);
    const sentence = todo.replace(`**${label}**: `, '');
    write(place.querySelector('.rxs-todo'), marked(sentence.charAt(0).toUpperCase() + sentence.slice(1)));
  };

  const show = () => {
    if (!now || !steps.length) return;
    const {at, guess, answer, stop} = now;
    column.dataset.step = at + 1;
    [...list.children].forEach((step, k) => {
      step.inert = k !== at;
      const own = k === at ? now : {guess: null, answer: null};
      for (const button of step.querySelectorAll('.rxs-guess button')) {
        const n = Number(button.dataset.value);
        button.disabled = own.guess !== null;
        if (own.guess === n) button.dataset.chosen = 'your guess';
        else delete button.dataset.chosen;
        button.toggleAttribute('data-right', Boolean(own.answer) && own.answer.right === n);
      }
    });
    const part = section(at), place = part.querySelector('.rxs-answer'), step = steps[at];
    // What is compared on the page, whatever the step began with.
    const pair = part.querySelector('.rxs-pair'), note = part.querySelector('.rxs-note');
    pair.hidden = !now.a || !now.b;
    write(pair.children[1], text(now.a));
    write(pair.children[3], text(now.b));
    note.hidden = !now.note;
    note.textContent = now.note;
    for (const other of list.querySelectorAll('.rxs-answer')) other.hidden = other !== place || guess === null;
    if (guess !== null) {
      const right = answer && answer.right === guess;
      const open = answer && answer.open.includes(guess) ? 'Unclear: the band holds this answer too.' : 'No.';
      const verdict = `<b class="rxs-verdict" data-right="${right}">${right ? 'Right.' : open}</b>`;
      place.querySelector('p').innerHTML = answer ? `${verdict} ${marked(answer.answer)}`
        : text(now.problem || 'Computing …');
      drawChart(place.querySelector('figure'), answer, stop);
    }
    const out = part.querySelector('output'), slider = part.querySelector('[data-stop]');
    out.textContent = step.control.words.length ? step.control.words[stop] ?? '' : now.problem || 'computing …';
    if (slider) {
      if (document.activeElement !== slider || !slider.matches(':active')) slider.value = stop ?? 0;
      slider.disabled = !step.control.words.length;
      slider.ariaValueText = out.textContent;
      const play = part.querySelector('[data-sweep]');
      play.disabled = slider.disabled;
      play.dataset.on = Boolean(sweep);
    }
    for (const button of part.querySelectorAll('[data-do=stop]'))
      button.ariaPressed = String(Number(button.dataset.value) === stop);
    foot.querySelectorAll('.rxs-dots button').forEach((dot, k) => {
      dot.ariaCurrent = k === at ? 'step' : 'false';
    });
    foot.querySelector('[data-value=back]').disabled = at === 0;
    foot.querySelector('[data-value=next]').textContent = step.last ? 'Fly it' : 'Next';
    figures.hidden = false;
    const banded = now.figures.some(([, , within]) => within);
    write(figures, now.figures.map(([title, value, within]) => `<div>
      <b class="rxf-num" ${value === '?' ? 'data-unknown' : ''}>${text(value)}</b>
      <span>${text(title)}</span>${banded ? `<i class="rxf-num">${text(within)}</i>` : ''}</div>`).join(''));
    keep();
  };

  // Lines over what is moved, with the present place on each.
  const drawChart = (figure, answer, stop) => {
    if (!answer) { figure.innerHTML = ''; return; }
    // As high as it fits above the control, which stays in sight.
    const part = figure.closest('section'), [from, to] = [part, figure].map(one => one.getBoundingClientRect().top);
    const free = list.clientHeight - (to - from) - part.querySelector('.rxs-control').offsetHeight;
    const dots = (answer.dots[stop] ?? []).map(([x, y, colour]) => ({kind: 'points', x: [x], y: [y], colour, size: 6}));
    const height = clamp(free - 52, 100, 190), width = Math.max(figure.clientWidth, 260);
    Charts.fill(figure, {...answer.chart, series: [...answer.chart.series, ...dots]}, {width, height});
  };

  // The step that stands keeps its place in the column, scrolled by `within`, whatever is laid out anew. Another is
  // asked for only where the hand scrolled to it: what the browser scrolls by itself, for a layout or the focus, asks
  // for none.
  let hand = false, aiming = false, within = 0, settle = 0;
  const seen = () => [...list.children].findIndex(step =>
    step.offsetTop + step.offsetHeight - list.scrollTop > 0.5 * list.clientHeight);
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
    if (hand && at >= 0 && at !== now.at) report('story', at);
    else { hand = false; keep(); }
  };
  list.addEventListener('scroll', () => {
    if (now && !aiming && seen() === now.at) within = list.scrollTop - section(now.at).offsetTop;
    rest();
  });
  const byHand = event => {
    if (!['wheel', 'touchmove'].includes(event.type) && event.target !== list) return;
    hand = true;
    aiming = false;
  };
  for (const name of ['wheel', 'touchmove', 'pointerdown', 'keydown'])
    list.addEventListener(name, byHand, {passive: true});

  // The control: a slider reports its position once a frame at most; play walks it to the end and back to where it was.
  let latest = 0;
  const reportStop = soon(() => report('stop', latest));
  const move = stop => { latest = stop; reportStop(); };
  const halt = () => { clearInterval(sweep); sweep = 0; };
  column.addEventListener('input', event => {
    if (!event.target.matches('[data-stop]')) return;
    event.stopPropagation();
    halt();
    move(Number(event.target.value));
  });
  column.addEventListener('click', event => {
    const button = closest(event, 'button');
    if (!button || button.disabled) return;
    if (!('sweep' in button.dataset)) return halt();
    if (sweep) { halt(); show(); return; }
    const last = steps[now.at].control.words.length - 1, from = now.stop;
    let k = from >= last ? 0 : from;
    sweep = setInterval(() => {
      if (now.busy || document.hidden) return;
      k += 1;
      if (k > last) { halt(); move(from); show(); } else move(k);
    }, 420);
    show();
  });
  new ResizeObserver(() => {
    if (now && steps.length) within = clamp(within, 0, section(now.at).offsetHeight - list.clientHeight);
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
