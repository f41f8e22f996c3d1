"""What the page itself must do for pictures: turn a drawing into pixels, and save them."""

import json

_SCRIPT = """(async () => {
  const said = text => localStorage.setItem('viser-user:' + KEY, text);
  try {
    const address = URL.createObjectURL(new Blob([DRAWING], {type: 'image/svg+xml;charset=utf-8'}));
    const image = new Image();
    image.src = address;
    await image.decode();
    const canvas = document.createElement('canvas');
    canvas.width = WIDTH;
    canvas.height = HEIGHT;
    canvas.getContext('2d').drawImage(image, 0, 0, WIDTH, HEIGHT);
    URL.revokeObjectURL(address);
    const pixels = await new Promise(done => canvas.toBlob(done, 'image/png'));
    if (!pixels) throw new Error('no memory for so many pixels');
    const link = document.createElement('a');
    link.href = URL.createObjectURL(pixels);
    link.download = NAME;
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 60000);
    said(String(pixels.size));
  } catch (error) {
    said('failed: ' + error.message);
  }
})()"""


def picture_script(drawing: str, width: int, height: int, name: str, key: str) -> str:
    """JavaScript that saves an SVG as a PNG of so many pixels, and says under `key` how many bytes, or why not."""
    words = {"DRAWING": drawing, "NAME": name, "KEY": key}
    script = _SCRIPT.replace("WIDTH", str(width)).replace("HEIGHT", str(height))
    for word in ("NAME", "KEY", "DRAWING"):  # The drawing last: what it holds is not looked into.
        script = script.replace(word, json.dumps(words[word]))
    return script
