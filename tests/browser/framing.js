// How the subject of the camera lies in its room: what is cut by the canvas, and which cards hide it. The subject is
// the lifted blade, the reference blade, or the rim of the rotor with the words round it.
view => {
  const {camera, canvas, nodeRefFromName: nodes} = window.__viserMutable, room = canvas.getBoundingClientRect(), found = [];
  const project = (of, [x, y, z]) => {
    const at = camera.position.clone().set(x, y, z).applyMatrix4(of.matrixWorld).project(camera);
    return [room.left + (at.x + 1) / 2 * room.width, room.top + (1 - at.y) / 2 * room.height];
  };
  const corners = name => {
    let mesh = null;
    nodes[name].updateWorldMatrix(true, true);
    nodes[name].traverse(one => { if (one.isMesh && !one.isLineSegments2) mesh ??= one; });
    const {array} = mesh.geometry.attributes.position, points = [];
    for (let k = 0; k < array.length; k += 30) points.push(project(mesh, [array[k], array[k + 1], array[k + 2]]));
    return points;
  };
  const blade = nodes['/rotor/blade_0'], radius = blade.geometry?.boundingBox?.max.x ?? 8.2, disk = nodes['/rotor/disk'];
  disk.updateWorldMatrix(true, false);
  const round = by => Array.from({length: 72}, (_, k) => project(disk, [by * radius * Math.cos(k * Math.PI / 36), by * radius * Math.sin(k * Math.PI / 36), 0]));
  const subject = view === 'actuator' ? corners('/lifted/skin') : view === 'blade' ? corners('/rotor/blade_0') : round(1);
  const whole = view === 'actuator' || view === 'blade' ? subject : round(1.18);
  const [left, right, top, bottom] = [Math.min(...whole.map(([x]) => x)), Math.max(...whole.map(([x]) => x)), Math.min(...subject.map(([, y]) => y)), Math.max(...subject.map(([, y]) => y))];
  if (left < room.left - 2 || right > room.right + 2 || top < room.top - 2 || bottom > room.bottom + 2)
    found.push(`${view} is cut by the canvas: ${[left - room.left, room.right - right, top - room.top, room.bottom - bottom].map(Math.round)}`);
  const cards = [...document.querySelectorAll('#rx .rxf-card, #rx .rxf-notice, [data-dock-region]')].filter(card => card.checkVisibility({opacityProperty: true, visibilityProperty: true}) && card.getClientRects()[0]?.width);
  for (const card of cards) {
    const box = card.getBoundingClientRect(), hidden = subject.filter(([x, y]) => x > box.left + 2 && x < box.right - 2 && y > box.top + 2 && y < box.bottom - 2).length;
    if (hidden) found.push(`${view} is ${Math.round(100 * hidden / subject.length)} % behind ${card.dataset.explorer || card.dataset.part || card.dataset.dockRegion || card.className}`);
  }
  return found;
}
