"""How the report looks, on light, dark and paper, and the few lines of script that turn its 3D picture on."""

_LIGHT = "--ink:#1f2429;--dim:#68717a;--paper:#fff;--card:#f6f7f9;--line:#e3e6ea;--grid:#edeff2;--less:#0b7a5e;"
_LIGHT += "--more:#c2410c;--care:#fff6e5;--care-ink:#7a4a00;--good:#e9f7f2;--good-ink:#0b6b53"
_DARK = "--ink:#e6e9ec;--dim:#98a1aa;--paper:#131416;--card:#1c1e21;--line:#32363b;--grid:#26292d;--less:#38d9a9;"
_DARK += "--more:#ff922b;--care:#2e2414;--care-ink:#ffd58a;--good:#13271f;--good-ink:#7fe0bf"

SHEET = f"""
:root{{{_LIGHT};color-scheme:light}}
@media (prefers-color-scheme:dark){{:root:not([data-theme=light]){{{_DARK};color-scheme:dark}}}}
:root[data-theme=dark]{{{_DARK};color-scheme:dark}}
@media print{{:root:root:root{{{_LIGHT};color-scheme:light}}}}
*{{box-sizing:border-box}}
body{{margin:0;background:var(--paper);color:var(--ink);font:15px/1.5 system-ui,-apple-system,"Segoe UI",sans-serif}}
main{{max-width:1120px;margin:0 auto;padding:36px 28px 60px}}
header{{position:relative;border-bottom:1px solid var(--line);padding-bottom:14px;margin-bottom:26px}}
.brand{{font-size:12.5px;font-weight:600;letter-spacing:.08em;text-transform:uppercase;color:#1c7ed6}}
h1{{font-size:30px;line-height:1.2;letter-spacing:-.4px;margin:6px 0 4px;max-width:24em}}
h2{{font-size:21px;letter-spacing:-.2px;margin:44px 0 10px}}
h3{{font-size:14px;margin:24px 0 8px}}
a{{color:inherit;text-decoration:none}}a:hover{{text-decoration:underline}}
details{{margin:4px 0}}summary{{cursor:pointer;font-size:13.5px}}
pre{{background:var(--card);border:1px solid var(--line);border-radius:6px;padding:10px 14px;
font-size:12.5px;overflow-x:auto}}
p{{margin:6px 0}}
.dim,small{{color:var(--dim)}}small{{font-size:12.5px}}
button{{font:inherit;font-size:13px;color:inherit;background:var(--card);border:1px solid var(--line);border-radius:6px;
padding:4px 12px;cursor:pointer}}button:hover,button.on{{border-color:#1c7ed6}}button.on{{color:#1c7ed6}}
#theme{{position:absolute;right:0;top:0}}
.cards{{display:grid;grid-template-columns:repeat(auto-fit,minmax(300px,1fr));gap:14px}}
.card{{background:var(--card);border:1px solid var(--line);border-left:4px solid var(--mark);border-radius:8px;
padding:12px 16px 13px}}
.card h3{{margin:0;font-size:13px;color:var(--mark)}}
.big{{display:flex;align-items:baseline;gap:10px}}.big b{{font-size:29px;font-weight:650;letter-spacing:-.6px}}
.big b,.big .dim{{white-space:nowrap}}
.big .change{{white-space:normal;text-align:right;line-height:1.2}}
.change{{margin-left:auto;font-size:17px;font-weight:600}}.change.dim{{font-size:13px;font-weight:400}}
.less{{color:var(--less)}}.more{{color:var(--more)}}
.bar{{display:flex;gap:1px;height:10px;margin:3px 0 8px;background:var(--grid);border-radius:2px;overflow:hidden}}
.parts,.key{{display:flex;flex-wrap:wrap;gap:4px 18px;font-size:13px;color:var(--dim);margin:9px 2px}}
.parts i,td>i{{display:inline-block;width:10px;height:10px;border-radius:2px;margin-right:6px}}
.stage{{margin-top:30px}}
.stage iframe{{display:block;width:100%;aspect-ratio:16/9;border:1px solid var(--line);border-radius:8px}}
.tabs{{display:flex;flex-wrap:wrap;gap:8px;align-items:center;margin-bottom:8px}}.tabs .dim{{font-size:13px}}
.scale{{max-width:400px;margin:8px 0 0 -20px}}
.wide{{overflow-x:auto}}
table{{border-collapse:collapse;font-size:13.5px;font-variant-numeric:tabular-nums;width:100%}}
td,th{{padding:4px 0 4px 14px;text-align:right;vertical-align:top;border-bottom:1px solid var(--line)}}
td:first-child,th:first-child{{text-align:left;padding-left:0;white-space:nowrap}}
th{{font-size:13px}}
.comparison td{{min-width:110px}}.comparison th:first-child{{width:170px}}
.blade table{{font-size:12.5px}}.blade td,.blade th{{padding-left:8px}}.blade .words td{{font-size:11px}}
.comparison table{{table-layout:fixed}}.comparison .words td{{font-size:12.5px;line-height:1.4}}
.comparison .total td{{border-top:2px solid var(--line);font-weight:600}}.total small{{font-weight:400}}
.tables{{display:grid;grid-template-columns:repeat(auto-fit,minmax(300px,1fr));gap:0 40px}}
.tables td:last-child{{white-space:nowrap}}
.design{{border-top:3px solid var(--mark);margin-top:54px}}.design h2{{margin-top:16px;color:var(--mark)}}
.lead{{font-size:18px;font-weight:600}}
.care,.good{{border-radius:6px;padding:9px 14px;margin:14px 0;font-size:14px}}
.care{{background:var(--care);color:var(--care-ink);list-style:none}}.care li::before{{content:"▲ "}}
.good{{background:var(--good);color:var(--good-ink)}}
.note{{font-size:13px;color:var(--dim)}}
figure{{margin:0}}figcaption{{display:flex;flex-wrap:wrap;gap:2px 14px;align-items:baseline;font-size:14px}}
figcaption .key{{margin:0;flex-basis:100%;gap:2px 12px}}.chart{{margin-bottom:6px}}
.charts{{display:grid;grid-template-columns:repeat(auto-fit,minmax(420px,1fr));gap:18px 30px}}
.disks{{display:grid;grid-template-columns:repeat(4,1fr);gap:14px 22px}}
.chart>svg,.disks svg,.bar-svg{{display:block;width:100%;height:auto;overflow:visible}}
.grid{{stroke:var(--grid);fill:none}}.axis{{stroke:var(--dim);fill:none}}.dot{{stroke:var(--paper);stroke-width:1.5}}
.key svg{{vertical-align:middle}}
footer{{border-top:1px solid var(--line);margin-top:54px;font-size:14px}}footer h2{{margin-top:22px}}
.versions{{width:auto;margin-top:14px}}
@media (max-width:900px){{.disks{{grid-template-columns:repeat(2,1fr)}}.charts{{grid-template-columns:1fr}}}}
@media (max-width:520px){{main{{padding:20px 14px}}#theme{{position:static;float:right}}h1{{font-size:24px}}}}
@media print{{
@page{{margin:14mm}}
main{{max-width:none;padding:0}}body{{font-size:10.5pt}}
.stage,#theme,details{{display:none}}
.card,figure,tr,.care,.tables>div{{break-inside:avoid}}h2,h3{{break-after:avoid}}
.design{{break-before:page;margin-top:0}}
.cards,.charts{{grid-template-columns:1fr 1fr}}.tables{{grid-template-columns:repeat(3,1fr);gap:0 16px}}
table,.comparison .words td,.blade table{{font-size:8pt}}.wide{{overflow:visible}}
.tables td:first-child{{white-space:normal}}.comparison table{{width:100%!important}}
.comparison td{{min-width:0}}.blade .words td,small{{font-size:7pt}}
*{{-webkit-print-color-adjust:exact;print-color-adjust:exact}}
}}
"""

SCRIPT = """
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
"""
