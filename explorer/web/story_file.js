// The lecture as a file: what the server would answer is in it, by step and by position of the control.
(() => {
  const data = JSON.parse(document.getElementById('story-data').textContent), root = document.documentElement;
  const page = document.getElementById('rx'), part = name => page.querySelector(`[data-part=${name}]`), rotor = window.stillRotor(data);
  const state = {at: 0, stop: data.steps[0].start, guesses: {}}, calm = matchMedia('(prefers-reduced-motion: reduce)');
  let psi = 1.1, before = 0, shaped = 0, aimed = '', shown = null;

  const report = (what, value) => {
    if (what === 'story') Object.assign(state, {at: value, stop: data.steps[value].start});
    if (what === 'stop') state.stop = value;
    if (what === 'guess') state.guesses[state.at] ??= value;
    show();
  };
  const story = window.makeStory(part('caption'), part('figures'), report);
  document.addEventListener('click', event => {
    const button = event.target instanceof Element && event.target.closest('[data-do]');
    if (!button || button.disabled) return;
    const {do: what, value} = button.dataset, last = data.steps.length - 1;
    if (what !== 'lecture') report(what, Number(value));
    else report('story', value === 'back' ? Math.max(state.at - 1, 0) : state.at < last ? state.at + 1 : 0);
  });
  document.addEventListener('keydown', event => {
    const by = {PageDown: 1, PageUp: -1}[event.key];
    if (!by) return;
    event.preventDefault();
    report('story', Math.min(Math.max(state.at + by, 0), data.steps.length - 1));
  });

  const now = () => data.steps[state.at].stops[state.stop];
  const roots = () => [['/rotor', now().b], ['/compared', now().a]].filter(([, point]) => point !== null).map(([name, point]) => [name, data.points[point]]);
  const show = () => {
    const step = data.steps[state.at], guess = state.guesses[state.at] ?? null;
    story.show({
      at: state.at, guess, answer: guess === null ? null : step, stop: state.stop, figures: guess === null ? now().figures.map(([title]) => [title, '?']) : now().figures,
      busy: false, held: false, problem: '', finish: 'Start again',
    });
    part('field').textContent = step.scale.title;
    part('unit').textContent = step.scale.unit;
    part('scale').innerHTML = `<div class="rxf-grad"><i style="background:${step.scale.colours[0]}"></i><i style="background:linear-gradient(90deg,${step.scale.colours.join()})"></i><i style="background:${step.scale.colours.at(-1)}"></i></div>${Charts.bar(step.scale.ticks)}`;
    rotorWipe.name(`A: ${step.a}`, `B: ${step.b}`);
    if (!page.hasAttribute('data-ready') || shown === now()) return;
    shown = now();
    rotorWipe.set(now().a !== null);
    for (const [name, point] of roots()) {
      rotor.pose(name, point.poses[0]);
      rotor.pose(`${name}/disk`, point.poses[1]);
      rotor.paint(name, point);
    }
    rotor.pose('/airframe', data.points[now().b].poses[2]);
    shape();
    aim();
  };
  const shape = () => {
    for (const [name, point] of roots()) {
      rotorScene.pose(point.motion, psi);
      rotor.shape(name, point, psi);
    }
  };
  const aim = () => {
    const canvas = window.__viserMutable.canvas, aspect = canvas.clientWidth / canvas.clientHeight, {cameras} = data.steps[state.at];
    const [, position, target] = cameras.findLast(([least]) => least <= aspect) ?? cameras[0];
    if (aimed === String(position)) return;
    aimed = String(position);
    rotorScene.look(position, target);
  };

  // The rotor turns slowly; twist follows the azimuth in every third picture or so.
  const turn = time => {
    requestAnimationFrame(turn);
    const passed = Math.min((time - before) / 1000, 0.1);
    before = time;
    if (calm.matches || document.hidden) return;
    psi = (psi + data.rate * passed) % (2 * Math.PI);
    for (const [, point] of roots()) rotorScene.pose(point.motion, psi);
    if (time - shaped > 66) { shaped = time; shape(); }
  };
  let place = '';
  const look = () => {
    const box = window.__viserMutable.canvas.getBoundingClientRect(), at = [box.left, box.top, box.width, box.height].join();
    if (at === place) return;
    place = at;
    for (const [name, value] of [['--rx-x', box.left], ['--rx-y', box.top], ['--rx-w', box.width], ['--rx-h', box.height]]) root.style.setProperty(name, `${value}px`);
    for (let e = window.__viserMutable.canvas.parentElement; e && e.id !== 'root'; e = e.parentElement) if (/background-color/.test(e.getAttribute('style') ?? '')) e.classList.add('rxf-ground');
    if (page.hasAttribute('data-ready')) aim();
  };

  const begin = () => {
    if (!rotor.node('/compared/blade_0') || !rotor.node('/compared/disk/field') || !rotor.node('/airframe')) return setTimeout(begin, 100);
    page.dataset.ready = 'true';
    rotorScene.dress(data.surfaces);
    rotorWipe.keepAlone();
    setInterval(look, 200);
    look();
    show();
    requestAnimationFrame(turn);
  };
  root.dataset.lecture = root.dataset.story = '';
  part('caption').hidden = false;
  story.steps(data.steps);
  show();
  begin();
})();
