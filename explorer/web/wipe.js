// A and B at one place: A is seen left of a handle, B right of it. The scene holds both; each frame is drawn twice, the
// second time inside the left part alone. viser's scene calls what is set here before and after each drawing of it.
(() => {
  const stage = document.querySelector('.rxf-stage'), place = stage.querySelector('[data-part=wipe]'), handle = place.querySelector('[role=slider]');
  const node = name => window.__viserMutable?.nodeRefFromName?.[name];
  let on = false, alone = false, at = 0.5, second = false, hooked = null, told = null;

  const side = a => {
    for (const [name, seen] of [['/compared', a], ['/rotor', !a]]) if (node(name)) node(name).visible = seen;
  };
  const hook = scene => {
    hooked = scene;
    scene.onBeforeRender = (_, __, ___, target) => { if ((on || alone) && !target && node('/compared')) side(second); };
    const after = scene.onAfterRender;
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
  };
  const look = () => {
    const viewer = window.__viserMutable, scene = viewer?.scene;
    if (scene && scene !== hooked) hook(scene);
    viewer?.requestRender?.();
  };
  const show = () => {
    place.hidden = !on;
    place.style.setProperty('--rx-wipe', at);
    handle.ariaValueNow = Math.round(100 * at);
    look();
  };
  const put = (share, tell = true) => {
    at = Math.min(Math.max(share, 0.02), 0.98);
    show();
    if (tell) told?.(Math.round(1000 * at) / 1000);
  };
  let held = false;
  handle.addEventListener('pointerdown', event => { held = true; handle.setPointerCapture(event.pointerId); event.preventDefault(); handle.focus(); });
  handle.addEventListener('pointermove', event => {
    if (!held) return;
    const box = stage.getBoundingClientRect();
    put((event.clientX - box.left) / box.width);
  });
  for (const over of ['pointerup', 'pointercancel']) handle.addEventListener(over, () => { held = false; });
  handle.addEventListener('keydown', event => {
    const by = {ArrowLeft: -0.05, ArrowRight: 0.05}[event.key];
    if (!by) return;
    event.preventDefault();
    event.stopPropagation();
    put(at + by);
  });
  // Both are seen again where nothing is wiped.
  const end = () => { for (const name of ['/compared', '/rotor']) if (node(name)) node(name).visible = true; };

  window.rotorWipe = {
    set(wanted, share) {
      if (on && !wanted) end();
      on = wanted;
      if (share !== undefined && share !== null && !held) at = share;
      show();
    },
    name(a, b) { place.querySelector('[data-side=a]').textContent = a; place.querySelector('[data-side=b]').textContent = b; },
    // A is seen in the wipe or not at all; in the page the server hides it.
    keepAlone() { alone = true; show(); },
    heard(listener) { told = listener; },
    get at() { return at; },
  };
  setInterval(() => { if (on) look(); }, 500);  // A page that connects again has another scene.
})();
