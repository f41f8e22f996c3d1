// @ts-check
// The theme of the report, and its 3D picture, loaded when it comes into view.
(() => {
  const root = document.documentElement, system = matchMedia('(prefers-color-scheme: dark)');
  const dark = () => (root.dataset.theme || (system.matches ? 'dark' : 'light')) === 'dark';
  const frame = document.getElementById('viewer'), held = document.getElementById('stage');
  const stage = held && JSON.parse(held.textContent), tabs = [...document.querySelectorAll('[data-scene]')];
  let shown = -1;
  const show = (k) => {
    shown = k;
    tabs.forEach((tab, n) => tab.classList.toggle('on', n === k));
    frame.srcdoc = stage.before + stage.scenes[k] + stage.between + dark() + stage.after;
  };
  tabs.forEach((tab, k) => { tab.onclick = () => show(k); });
  if (stage) new IntersectionObserver((seen, watch) => {
    if (seen.some((one) => one.isIntersecting)) { watch.disconnect(); show(0); }
  }).observe(frame);
  const themed = () => { if (shown >= 0) show(shown); };
  system.addEventListener('change', themed);
  document.getElementById('theme').onclick = () => { root.dataset.theme = dark() ? 'light' : 'dark'; themed(); };
})();
