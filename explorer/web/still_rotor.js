// @ts-check
// Rotors of a file without a server: blades shaped from harmonics of their pitch, and pictures on the disk, by the
// points that `explorer/export/still_rotor.py` makes. `data` holds the blade's shape, its rings and faces.
window.stillRotor = data => {
  const bytes = text => Uint8Array.from(atob(text), letter => letter.charCodeAt(0)).buffer;
  const floats = text => new Float32Array(bytes(text));
  const faces = new Uint32Array(bytes(data.faces));
  const shape = floats(data.shape), [rings, points] = data.rings;
  const {viewer, node, setPose} = Common;
  const waves = new Map(), images = new Map(), wanted = {};

  // After the rings come those of root and tip once more, and the centres of both.
  const ringOf = [...Array(rings).keys(), 0, rings - 1].flatMap(ring => Array(points).fill(ring)).concat(0, rings - 1);
  const turned = pitch => {
    const vertices = new Float32Array(shape);
    for (let v = 0; v < shape.length / 3; v++) {
      const angle = pitch[ringOf[v]], cos = Math.cos(angle), sin = Math.sin(angle);
      const y = shape[3 * v + 1], z = shape[3 * v + 2];
      vertices[3 * v + 1] = y * cos - z * sin;
      vertices[3 * v + 2] = y * sin + z * cos;
    }
    return vertices;
  };
  // Harmonics 1, cos ψ, sin ψ, cos 2ψ, … of the pitch of each ring.
  const pitchAt = (series, angle) => Array.from({length: rings}, (_, ring) => {
    let sum = series[ring];
    for (let row = 1; row < series.length / rings; row++) {
      const n = Math.ceil(row / 2);
      sum += series[row * rings + ring] * (row % 2 ? Math.cos(n * angle) : Math.sin(n * angle));
    }
    return sum;
  });
  // A viewer keeps a mesh with shared corners, or one corner for each face: both are filled.
  const fill = (name, vertices) => {
    node(name)?.traverse?.(part => {
      const geometry = part.geometry, position = geometry?.attributes?.position;
      if (!part.isMesh || !position) return;
      // Equal vertices are one array in the file, for all meshes that have them.
      if (!geometry.userData.own) { position.array = position.array.slice(); geometry.userData.own = true; }
      if (position.array.length === vertices.length) position.array.set(vertices);
      else if (position.array.length === 3 * faces.length)
        faces.forEach((corner, n) => position.array.set(vertices.subarray(3 * corner, 3 * corner + 3), 3 * n));
      else return;
      position.needsUpdate = true;
      geometry.computeVertexNormals();
      geometry.computeBoundingSphere();
    });
  };
  const kept = (store, key, make) => { if (!store.has(key)) store.set(key, make()); return store.get(key); };

  return {
    node,
    pose(name, [wxyz, position]) { setPose(name, wxyz, position); },
    // The blades of the rotor below this node, the first one at `angle`.
    shape(root, point, angle) {
      const series = kept(waves, point.flown, () => floats(point.flown)), {blades} = point.motion;
      for (let k = 0; k < blades; k++)
        fill(`${root}/blade_${k}`, turned(pitchAt(series, angle + 2 * Math.PI * k / blades)));
      viewer().requestRender?.();
    },
    // The picture on its disk; the newest one that was asked for is what stays.
    async paint(root, point) {
      wanted[root] = point;
      const image = await kept(images, point.disk, () => new Promise(done => {
        const picture = new Image();
        picture.onload = () => done(picture);
        picture.src = `data:image/webp;base64,${point.disk}`;
      }));
      const put = () => {
        if (wanted[root] !== point) return;
        let there = false;
        node(`${root}/disk/field`)?.traverse?.(part => {
          if (!part.isMesh || !part.material?.map) return;
          there = true;
          part.material.map.dispose();
          part.material.map.image = image;
          part.material.map.needsUpdate = true;
        });
        if (there) viewer().requestRender?.();
        else setTimeout(put, 100);  // The viewer has not decoded its own picture yet, whose place this one takes.
      };
      put();
    },
  };
};
