// @ts-check
// The lecture in the page: what the server says of it, drawn by `story.js`.
(() => {
  const page = document.documentElement, place = RX.part('caption');
  const story = window.makeStory(place, RX.part('figures'), (what, value) => RX.send(what, value));
  const name = () => {
    const {lecture, bar} = RX.state;
    rotorWipe.name(`A: ${lecture?.a || bar?.pinned?.title || ''}`, lecture?.b ? `B: ${lecture.b}` : 'B');
  };
  RX.paint('wipe', on => { name(); rotorWipe.set(on); });
  RX.paint('steps', steps => story.steps(steps));
  RX.paint('lecture', step => {
    const begins = step && !page.hasAttribute('data-lecture');
    page.toggleAttribute('data-lecture', Boolean(step));
    page.toggleAttribute('data-guess', step?.answer === null);
    place.hidden = !step;
    if (begins || !step) {
      RX.openRail(!step && RX.small.matches);  // Full-bleed, until the controls are asked for.
      if (!step) story.end();
      window.dispatchEvent(new Event('resize'));
    }
    if (step) { story.show(step); name(); }
  });
})();
