// @ts-check
// A and B at one place: A is seen left of a handle, B right of it. The scene holds both; each frame is drawn twice, the
// second time inside the left part alone. viser's scene calls what is set here before and after each drawing of it.
(() => {
  const {clamp, drag, viewer, node} = Common, stage = document.querySelector('.rxf-stage');
  const place = stage.querySelector('[data-part=wipe]'), handle = place.querySelector('[role=slider]');
  let on = false, at = 0.5, second = false, hooked = null;

  const see = (a, b) => {
    for (const [name, seen] of [['/compared', a], ['/rotor', b]]) if (node(name)) node(name).visible = seen;
  };
  function hook(scene) {
    hooked = scene;
    const before = scene.onBeforeRender, after = scene.onAfterRender;
    scene.onBeforeRender = (...all) => {
      const target = all[3];
      before.apply(scene, all);
      if (on && !target && node('/compared')) see(second, !second);
    };
    scene.onAfterRender = (...all) => {
      const [renderer, , camera, target] = all;
      after.apply(scene, all);
      if (!on || target || second || !node('/compared')) return;
      const {clientWidth, clientHeight} = renderer.domElement;
      second = true;
      renderer.setScissor(0, 0, Math.round(at * clientWidth), clientHeight);
      renderer.setScissorTest(true);
      renderer.render(scene, camera);
      renderer.setScissorTest(false);
      second = false;
    };
  }
  function look() {
    const {scene} = viewer() ?? {};
    if (scene && scene !== hooked) hook(scene);
    viewer()?.requestRender?.();
  }
  function show() {
    place.hidden = !on;
    stage.style.setProperty('--rx-wipe', String(at));  // The plan of the disk reads it, too.
    handle.ariaValueNow = String(Math.round(100 * at));
    look();
  }
  function move(share) {
    at = clamp(share, 0.02, 0.98);
    show();
  }
  drag(handle, '*', (_, event) => {
    event.preventDefault();
    handle.setPointerCapture(event.pointerId);
    handle.focus();
    return {
      move({clientX}) {
        const {left, width} = stage.getBoundingClientRect();
        move((clientX - left) / width);
      },
    };
  });
  handle.addEventListener('keydown', event => {
    const step = {ArrowLeft: -0.05, ArrowRight: 0.05}[event.key];
    if (!step) return;
    event.preventDefault();
    event.stopPropagation();
    move(at + step);
  });

  window.rotorWipe = {
    set(wanted) {
      if (on && !wanted) see(true, true);  // Both are seen again where nothing is wiped.
      on = wanted;
      show();
    },
    name(a, b) {
      place.querySelector('[data-side=a]').textContent = a;
      place.querySelector('[data-side=b]').textContent = b;
    },
  };
  setInterval(() => { if (on) look(); }, 500);  // A page that connects again has another scene.
})();
