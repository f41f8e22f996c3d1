// @ts-check
// The lecture as a file: what the server would answer is in it, by step and by position of the control.
(() => {
  const {clamp, closest, calm, viewer, follow} = Common, page = document.getElementById('rx');
  const data = JSON.parse(document.getElementById('story-data').textContent), rotor = window.stillRotor(data);
  const part = name => page.querySelector(`[data-part=${name}]`);
  const state = {at: 0, stop: data.steps[0].start, guesses: {}}, last = data.steps.length - 1;
  let psi = 1.1, before = 0, shaped = 0, aimed = '', shown = null;

  const report = (what, value) => {
    if (what === 'story') Object.assign(state, {at: value, stop: data.steps[value].start});
    if (what === 'stop') state.stop = value;
    if (what === 'guess') state.guesses[state.at] ??= value;
    show();
  };
  const story = window.makeStory(part('caption'), part('figures'), report);
  document.addEventListener('click', event => {
    const button = closest(event, '[data-do]');
    if (!button || button.disabled) return;
    const {do: what, value} = button.dataset;
    if (what !== 'lecture') report(what, Number(value));
    else report('story', value === 'back' ? Math.max(state.at - 1, 0) : state.at < last ? state.at + 1 : 0);
  });
  document.addEventListener('keydown', event => {
    const step = {PageDown: 1, PageUp: -1}[event.key];
    if (!step) return;
    event.preventDefault();
    report('story', clamp(state.at + step, 0, last));
  });

  const now = () => data.steps[state.at].stops[state.stop];
  const roots = () => [['/rotor', now().b], ['/compared', now().a]]
    .filter(([, point]) => point !== null).map(([name, point]) => [name, data.points[point]]);
  const show = () => {
    const {at, stop} = state, step = data.steps[at], {title, unit, colours, ticks} = step.scale;
    const guess = state.guesses[at] ?? null, open = guess === null;
    const figures = now().figures.map(([name, value]) => [name, open ? '?' : value]), answer = open ? null : step;
    story.show({at, guess, answer, stop, figures, busy: false, held: false, problem: '', finish: 'Start again'});
    part('field').textContent = title;
    part('unit').textContent = unit;
    part('scale').innerHTML = Charts.bar(colours, ticks);
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
    const {clientWidth, clientHeight} = viewer().canvas, aspect = clientWidth / clientHeight;
    const {cameras} = data.steps[state.at];
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
  const look = () => { if (follow(viewer().canvas) && page.hasAttribute('data-ready')) aim(); };

  const begin = () => {
    const needed = ['/compared/blade_0', '/compared/disk/field', '/airframe'];
    if (!needed.every(rotor.node)) return setTimeout(begin, 100);
    page.dataset.ready = 'true';
    rotorScene.dress(data.surfaces);
    rotorWipe.keepAlone();
    setInterval(look, 200);
    look();
    show();
    requestAnimationFrame(turn);
  };
  for (const name of ['lecture', 'story']) document.documentElement.dataset[name] = '';
  part('caption').hidden = false;
  story.steps(data.steps);
  show();
  begin();
})();
