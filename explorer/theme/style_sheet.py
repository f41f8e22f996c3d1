"""The page's style sheet: classes of the read-outs, and a tighter set of rows in the panels."""

SHEET = """
/* The rows of the control panel, a little closer than they come. */
[style*="padding-bottom: 0.5em"] { padding-bottom: 0.3em !important; }
/* A box with a hint is no higher than one without. */
div:has(> .mantine-Checkbox-root) { display: flex !important; }
/* Tabs do not touch the row above them, nor a scroll bar what it stands beside. */
div:has(> [data-dock-area]) { margin-top: 0 !important; }
.mantine-ScrollArea-root { --scrollarea-scrollbar-size: 7px !important; }
/* What explains itself says so. */
.rx [title] { cursor: help; }
/* Tabs close enough for their names to stand in one row. */
[data-dock-tab] { padding: 0 0.37em !important; height: 2.15em !important; }
/* A row of buttons without a label has the whole width. */
[class*=Flex-root]:has(> div > p > label:empty) > :first-child { display: none; }
.rx { font-size: 12.5px; line-height: 1.37; padding: 0 14px; }
.rx-dim { color: var(--mantine-color-dimmed); }
.rx-small { font-size: 12px; }
.rx-line { display: flex; justify-content: space-between; gap: 8px; white-space: nowrap; }
.rx-base { align-items: baseline; justify-content: flex-start; }
.rx-push { margin-left: auto; }
.rx-num { text-align: right; font-variant-numeric: tabular-nums; }
.rx-total { font-size: 27px; font-weight: 650; letter-spacing: -0.5px; }
.rx-change { font-size: 17px; font-weight: 600; }
.rx-less { color: #0b8a6a; }
.rx-more { color: #d9480f; }
[data-mantine-color-scheme=dark] .rx-less { color: #38d9a9; }
[data-mantine-color-scheme=dark] .rx-more { color: #ff922b; }
.rx-bar { display: flex; gap: 1px; height: 10px; border-radius: 2px; overflow: hidden; margin: 5px 0 3px; }
.rx-bar { position: relative; }
.rx-mark { display: inline-block; width: 2px; height: 10px; background: currentColor; vertical-align: middle; }
.rx-bar .rx-mark { width: 2.5px; color: var(--mantine-color-text); }
.rx-kappa { font-size: 12px; padding-top: 1px; flex-wrap: wrap; }
.rx table { width: 100%; border-collapse: collapse; white-space: nowrap; }
.rx td { padding: 0; }
.rx-patch { display: inline-block; width: 9px; height: 9px; border-radius: 2px; margin-right: 7px; }
.rx-bars { display: grid; grid-template-columns: auto 1fr; column-gap: 6px; align-items: center; font-size: 12px;
  line-height: 12px; margin: 4px 0 3px; }
.rx-bars .rx-bar { margin: 1px 0; }
.rx-ab { table-layout: fixed; }
.rx-ab td:first-child { width: 34%; }
.rx-ab .rx-dash { margin-right: 4px; }
.rx-sum td { border-top: 1px solid rgba(128,128,128,.35); font-weight: 600; }
.rx-four { display: grid; grid-template-columns: 1fr 1fr 1fr; text-align: right; white-space: nowrap;
  font-variant-numeric: tabular-nums; }
.rx-four > :first-child { text-align: left; }
.rx-four .rx-dash { margin-right: 4px; }
.rx-fit { overflow: hidden; text-overflow: ellipsis; }
.rx-pinned { padding-bottom: 4px; }
.rx-grid { display: grid; grid-template-columns: 1fr 1fr; column-gap: 18px; padding-top: 4px; padding-bottom: 5px; }
.rx-status { margin: 4px 10px 2px; padding: 5px 8px; min-height: 32px; border-radius: 4px;
  font-size: 12px; line-height: 1.32; background: rgba(128,128,128,.10); }
.rx-reserved { border-radius: 4px; background: rgba(128,128,128,.06); }
.rx-status.rx-problem { padding: 0; background: none; }
.rx-sentence { padding: 5px 8px; border-radius: 4px; background: #c92a2a; color: #fff; }
.rx-good { color: #0ca678; }
.rx-care { display: flex; gap: 6px; }
.rx-care > span:first-child { color: #e67700; }
.rx-faded { opacity: .35; }
.rx-explain { height: 36px; }
.rx-heading { padding-top: 3px; margin-bottom: -2px; font-size: 12px; gap: 10px; }
.rx-heading > :first-child { font-weight: 600; margin-right: auto; }
.rx-dash { display: inline-block; width: 12px; height: 3px; vertical-align: middle; margin-right: 4px; }
.rx-dashed { background: repeating-linear-gradient(90deg, currentColor 0 5px, transparent 5px 7px); }
.rx-scale { font-size: 12px; padding-bottom: 4px; }
.rx-gradient { height: 12px; border-radius: 2px; margin-top: 3px; }
.rx-ticks { position: relative; height: 19px; }
.rx-ticks span { position: absolute; top: 4px; transform: translateX(-50%); }
.rx-ticks i { position: absolute; top: 0; width: 1px; height: 4px; background: currentColor; }
.rx-concept { padding-bottom: 4px; }
.rx-concept svg { display: block; margin: -2px 0 1px; }
.rx-where { min-height: 50px; }
.rx-found { padding-bottom: 5px; }
.rx-found td { padding: 0 0 0 5px; }
.rx-found td:first-child { padding-left: 0; }
.rx-best { font-size: 21px; font-weight: 650; letter-spacing: -0.4px; margin-right: 7px; }
.rx-broken { color: #c92a2a; }
[data-mantine-color-scheme=dark] .rx-broken { color: #ff8787; }
/* viser's button that makes a chart large is white in every theme. */
[data-mantine-color-scheme=dark] .js-plotly-plot + button { background: transparent !important; }
.rx-map { display: block; }
.rx-map image { image-rendering: auto; }
.rx-map-title { padding: 0 10px 0 36px; }
.rx-chip { padding: 0 7px; border-radius: 8px; font-size: 12px; line-height: 17px; align-self: center;
  border: 1px solid currentColor; }
.rx-chip-good { color: #0b8a6a; }
.rx-chip-bad { color: #b5179e; }
.rx-chip-back { color: #d9480f; }
[data-mantine-color-scheme=dark] .rx-chip-good { color: #38d9a9; }
[data-mantine-color-scheme=dark] .rx-chip-bad { color: #faa2c1; }
[data-mantine-color-scheme=dark] .rx-chip-back { color: #ff922b; }
.rx-probe svg { display: block; }
.rx-probe sub { font-size: 8.5px; line-height: 0; }
.rx-probe-title { padding-top: 7px; font-size: 12px; }
.rx-dialog { border: 0; outline: 0; border-radius: 8px; padding: 14px 8px 16px; max-width: min(760px, 94vw);
  color: var(--mantine-color-text); background: var(--mantine-color-body); box-shadow: 0 8px 40px rgba(0,0,0,.35); }
.rx-dialog::backdrop { background: rgba(0,0,0,.35); }
.rx-keys { columns: 2; column-gap: 34px; width: 690px; max-width: 100%; }
.rx-keys section { break-inside: avoid; padding-bottom: 9px; }
.rx-keys h4 { margin: 0 0 2px; font-size: 12.5px; }
.rx-keys .rx-line { padding: 1.5px 0; }
.rx-keys kbd { display: inline-block; min-width: 20px; margin-left: 3px; padding: 0 5px; text-align: center;
  font: inherit; font-size: 12px; border: 1px solid rgba(128,128,128,.45); border-radius: 4px;
  background: rgba(128,128,128,.10); }
/* A text field that only clicks write to: see explorer/charts/svg.py. */
div:has(> .rx-bridge), div:has(> .rx-bridge) + div { display: none !important; }
.rx-presence { margin: 2px 10px 4px; padding: 6px 10px; border-radius: 4px; background: rgba(28,126,214,.14); }
.rx-strip { display: block; }
.rx-take { cursor: pointer; }
.rx-kept-table td { padding: 3px 4px 3px 0; border-top: 1px solid rgba(128,128,128,.18); vertical-align: middle; }
.rx-kept { overflow: hidden; text-overflow: ellipsis; max-width: 130px; }
.rx .rx-wraps { white-space: normal; }
.rx-waterfall svg { display: block; }
.rx-w { font-size: 12px; fill: currentColor; }
.rx-w-strong { font-weight: 600; }
.rx-w-number { text-anchor: end; font-variant-numeric: tabular-nums; }
.rx-w-note { font-size: 12px; fill: var(--mantine-color-dimmed); stroke: var(--rx-paper); stroke-width: 3;
  paint-order: stroke; }
.rx-w-bad { fill: #d9480f; }
.rx-w-link { stroke: currentColor; stroke-opacity: .35; stroke-width: 1; stroke-dasharray: 2 2; }
.rx-alone { margin-top: 10px; }
.rx-alone tr + tr td { padding-top: 1.5px; }
.rx-export { min-height: 34px; padding-bottom: 6px; overflow-wrap: anywhere; color: var(--mantine-color-dimmed); }
.rx-export[data-kind=problem] { color: #c92a2a; }
[data-mantine-color-scheme=dark] .rx-export[data-kind=problem] { color: #ff8787; }
.rx-code { max-height: 52vh; overflow: auto; padding: 8px 10px; border-radius: 4px; font-size: 12px;
  line-height: 1.4; white-space: pre-wrap; overflow-wrap: anywhere; background: rgba(128,128,128,.12); }
.rx-trust h4 { margin: 11px 0 3px; font-size: 12.5px; line-height: 1.25; }
.rx-trust-row, .rx-trust-change { padding: 2px 0; border-top: 1px solid rgba(128,128,128,.18); }
.rx-trust-row { display: flex; justify-content: space-between; gap: 10px; }
.rx-trust-speeds { display: grid; grid-template-columns: repeat(3, 1fr); white-space: nowrap; }
.rx-lobby { padding: 0 2px 6px; font-size: 13.5px; line-height: 1.45; }
.rx-lobby p { margin: 0 0 9px; }
.rx-trust-row b { white-space: nowrap; font-weight: 600; }
"""

BIG = """
html:root { font-size: 16.5px !important; --mantine-scale: 1.2; }
html:root {
  #rx { font-size: 15px; }
  #rx .rxf-modes button, #rx .rxf-tools button, .rxf-head, .rxf-head b { font-size: 14.5px; }
  .rxf-since small, .rxf-sub, .rxf-why { font-size: 14.5px; }
  .rxf-change { min-width: 208px; }
  [data-dock-region] [class*=Flex-root] > [style*="flex-shrink: 0"] { width: 118px !important; }
  #rx .rxf-chip, .rxf-parts dl, .rxf-field, #rx .rxf-legend button { font-size: 13px; }
  #rx svg text, .rxp-curve svg text { font-size: 12.5px; }
  .rxp-title { font-size: 19px; }
  .rxp-head, .rxp-head span, .rxp-worth { font-size: 13px; }
  .rx, .rx-status, .rx-heading, .rx-scale, .rx-kappa { font-size: 15.5px; }
  .rx-small { font-size: 14px; }
  .rx-total { font-size: 38px; }
  .rx-change { font-size: 23px; }
}
@media (min-width: 1100px) { html:root {
  .rxf-total { font-size: 46px; }
  .rxf-caption h2 { font-size: 29px; }
  .rxf-caption p { font-size: 19.5px; }
  .rxf-figures b { font-size: clamp(44px, 4vw, 64px); }
} }
"""
"""Added to the sheet for those who sit at the back. `html:root` outweighs the frame's own sheets, which come later."""
