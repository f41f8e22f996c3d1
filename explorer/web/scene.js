// The scene's own script in the page: gloss of surfaces, and the turning rotor.
(() => {
  const viewer = () => window.__viserMutable;
  let seat = null, surfaces = {}, lit = {}, motion = null, compared = null, spin = 0, heard = null, mark = null, rate = 0, psi = 0, before = 0, stepped = 0;

  // Pictures seen from a low angle stay sharp with anisotropic filtering, which a graphics card gives for nothing.
  const hardware = () => {
    const gl = viewer().canvas?.getContext('webgl2'), info = gl?.getExtension('WEBGL_debug_renderer_info');
    return Boolean(info) && !/swiftshader|llvmpipe|software/i.test(gl.getParameter(info.UNMASKED_RENDERER_WEBGL));
  };
  let sharp = null;

  // Materials come and go with their nodes, so they are looked at again and again; a dressed one is left alone.
  const dress = () => {
    const nodes = viewer()?.nodeRefFromName;
    let changed = false;
    sharp ??= viewer()?.canvas ? hardware() : null;
    for (const [name, wanted] of Object.entries(surfaces))
      nodes?.[name]?.traverse?.(part => {
        const material = part.material;
        if (!part.isMesh || !material?.userData) return;
        if (wanted.flat && sharp && material.map && material.map.anisotropy < 8) {
          material.map.anisotropy = 8;
          material.map.needsUpdate = changed = true;
        }
        if (material.userData.dressed) return;
        if (wanted.flat ? !material.map : material.roughness === undefined) return;
        material.userData.dressed = changed = true;
        if (wanted.flat) material.depthWrite = false;
        else Object.assign(material, {roughness: wanted.roughness ?? 1, metalness: wanted.metalness ?? 0});
      });
    if (changed) viewer().requestRender?.();
  };
  // Pieces that shine by themselves: [colour, strength] by node. Looked at again and again for the same reason.
  const light = () => {
    let changed = false;
    for (const [name, [colour, strength]] of Object.entries(lit))
      viewer()?.nodeRefFromName?.[name]?.traverse?.(part => {
        const {material} = part, wanted = `${colour} ${strength}`;
        if (!part.isMesh || !material?.emissive || material.userData.lit === wanted) return;
        material.emissive.set(colour);
        material.emissiveIntensity = 0.9 * strength;
        material.userData.lit = wanted;
        changed = true;
      });
    if (changed) viewer().requestRender?.();
  };

  // Turned by psi about the shaft, flapped about the hinge, then pitched: R_z(ψ) R_y(−β) R_x(θ).
  const place = (name, angle, flap, pitch, hinge) => {
    const [a, b, c] = [angle / 2, -flap / 2, pitch / 2];
    const [ca, sa, cb, sb, cc, sc] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b), Math.cos(c), Math.sin(c)];
    viewer().nodePoseData[name] = {
      wxyz: [ca * cb * cc + sa * sb * sc, ca * cb * sc - sa * sb * cc, ca * sb * cc + sa * cb * sc, sa * cb * cc - ca * sb * sc],
      position: [hinge * Math.cos(angle), hinge * Math.sin(angle), 0], poseUpdateState: 'needsUpdate',
    };
  };
  // Of 1, cos ψ, sin ψ, cos 2ψ, …
  const harmonic = ([mean, ...waves], angle) =>
    waves.reduce((sum, size, k) => sum + size * (k % 2 ? Math.sin : Math.cos)((1 + (k >> 1)) * angle), mean);
  const pose = (of, at) => {
    for (let k = 0; k < of.blades; k++) {
      const angle = at + 2 * Math.PI * k / of.blades;
      place(`${of.root}/blade_${k}`, angle, harmonic(of.flap, angle), harmonic(of.pitch, angle), of.hinge);
    }
    place(`${of.root}/head`, at, 0, 0, 0);
  };
  const show = at => {
    pose(motion, at);
    if (compared) pose(compared, at);
    trail(at);
    viewer().requestRender?.();
  };

  // Tip vortices are moved point by point: behind a flying rotor they do not turn as a whole.
  const trail = at => {
    const node = viewer().nodeRefFromName[motion.vortices], {along, turns, points, radius, sink} = motion.path;
    const last = radius.length - 1, end = 2 * Math.PI * turns;
    node?.traverse?.(part => {
      const data = part.geometry?.attributes?.instanceStart?.data;
      if (data?.array?.length !== 6 * motion.blades * (points - 1)) return;
      let k = 0;
      for (let blade = 0; blade < motion.blades; blade++) {
        let previous = null;
        for (let j = 0; j < points; j++) {
          const age = end * j / (points - 1), left = at + 2 * Math.PI * blade / motion.blades - age;
          const i = Math.min(Math.floor(last * age / end), last - 1), u = last * age / end - i;
          const turn = left / (2 * Math.PI) * sink.length, column = Math.floor(turn), v = turn - column;
          const of = n => { const row = sink[((n % sink.length) + sink.length) % sink.length]; return (1 - u) * row[i] + u * row[i + 1]; };
          const r = (1 - u) * radius[i] + u * radius[i + 1], depth = (1 - v) * of(column) + v * of(column + 1);
          const here = [
            motion.radius * (r * Math.cos(left) + along * age), motion.radius * r * Math.sin(left),
            (motion.radius - motion.hinge) * harmonic(motion.flap, left) - motion.radius * depth,
          ];
          if (previous) { data.array.set(previous, k); data.array.set(here, k + 3); k += 6; }
          previous = here;
        }
      }
      data.needsUpdate = true;
    });
  };

  // The server says ten or twenty times a second where the reference blade is; in between the page goes on at that rate
  // and closes what is left between the two. Whoever asked for less motion sees the rotor at rest in steps of 30° or more,
  // at most two a second.
  const calm = matchMedia('(prefers-reduced-motion: reduce)');
  const near = angle => angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
  const LATE = 400;  // [ms] After which nothing more is expected of the server.
  let stepping = false;
  // Frames are asked for only while something turns; in software, where each keeps the processors busy, no rotor turns by itself.
  const follows = now => heard && !(heard.still && now - heard.at > LATE);
  const turning = now => motion && !seat && (follows(now) || (spin && sharp && !calm.matches));
  const go = () => {
    const now = performance.now();
    if (stepping || !turning(now)) return;
    stepping = true;
    before = now;
    requestAnimationFrame(step);
  };
  const step = now => {
    stepping = turning(now);
    if (!stepping) return;
    requestAnimationFrame(step);
    const passed = Math.max(0, Math.min((now - before) / 1000, 0.5)), own = Math.min(passed, 0.1);
    before = now;
    if (!follows(now)) { show(psi += spin * own); return; }
    const since = (now - heard.at) / 1000, going = since < 0.3 ? rate : 0, aim = heard.psi + rate * Math.min(since, 0.3), last = psi;
    if (calm.matches) {
      heard.still = Math.abs(near(aim - psi)) < Math.PI / 6;
      if (heard.still || now - stepped < 500) return;
      psi = aim;
      stepped = now;
    } else {
      psi += going * own + near(aim - psi - going * own) * Math.min(1, 5 * passed);
      heard.still = Math.abs(psi - last) < 1e-4;
    }
    show(psi);
  };

  const smooth = t => t * t * t * (t * (6 * t - 15) + 10);
  let flight = 0;

  window.rotorScene = {
    // Camera and a lifted blade fly to where the server puts them: the camera from where it is, the blade from the rotor's
    // reference blade to where it is held, or back. `offset`: of the blade's origin from the flap hinge, along it.
    lift(name, out, duration, held, offset) {
      const client = viewer(), control = client.cameraControl, own = ++flight, begun = performance.now();
      if (calm.matches || !control || !client.camera) return;
      const vector = () => client.camera.position.clone(), get = () => ({p: control.getPosition(vector()), t: control.getTarget(vector())});
      const start = get();
      let last = start, goal = null;
      const onRotor = () => {
        const root = client.nodeRefFromName[name]?.parent, blade = client.nodeRefFromName[`/rotor/blade_0`];
        if (!root || !blade) return null;
        blade.updateWorldMatrix(true, false);
        const at = root.matrixWorld.clone().invert().multiply(blade.matrixWorld), turn = blade.quaternion.clone(), origin = vector();
        at.decompose(origin, turn, vector());
        return {place: origin.add(vector().set(offset, 0, 0).applyQuaternion(turn)), turn};
      };
      const frame = now => {
        if (own !== flight) return;
        const e = smooth(Math.min(1, (now - begun) / duration)), here = get();
        if (!goal || here.p.distanceTo(last.p) > 1e-3 || here.t.distanceTo(last.t) > 1e-3) goal = here;
        const p = start.p.clone().lerp(goal.p, e), t = start.t.clone().lerp(goal.t, e);
        control.setLookAt(p.x, p.y, p.z, t.x, t.y, t.z, false);
        last = get();
        const blade = onRotor();
        if (blade) {
          const share = out ? e : 1 - e, [w, x, y, z] = held.wxyz;
          const position = blade.place.lerp(vector().set(...held.position), share), turn = blade.turn.slerp(blade.turn.clone().set(x, y, z, w), share);
          client.nodePoseData[name] = {wxyz: [turn.w, turn.x, turn.y, turn.z], position: position.toArray(), poseUpdateState: 'needsUpdate'};
        }
        client.requestRender?.();
        if (e < 1) requestAnimationFrame(frame);
      };
      frame(begun);
    },
    glow(wanted) { lit = wanted; light(); },
    // Turn at this rate [rad/s] while nothing is heard of the azimuth; 0: no more.
    spin(wanted) { spin = wanted; go(); },
    dress(wanted) { surfaces = wanted; },
    move(next) {
      const begins = !motion;
      motion = next;
      if (begins) { heard = mark = null; rate = 0; }
      go();
    },
    turn(angle) {
      const at = performance.now();
      if (!heard) psi = angle;
      // Messages come in bursts: the rate is taken over a quarter of a second. After a rest it begins anew.
      if (!mark || at - heard.at > 2 * LATE) { mark = {psi: angle, at}; rate = 0; }
      else if (at - mark.at > 250) { rate = near(angle - mark.psi) / ((at - mark.at) / 1000); mark = {psi: angle, at}; }
      heard = {psi: angle, at};
      go();
    },
    // The reference blade at ψ, and the camera behind and above its section so far out [m]; `leave` flies back.
    ride(angle, out, radius) {
      const client = viewer(), control = client?.cameraControl, node = client?.nodeRefFromName?.['/rotor/blade_0'], world = node?.parent;
      if (!motion || !control || !world) return;
      const point = node.position.clone();
      if (!seat) seat = {from: control.getPosition(point.clone()), to: control.getTarget(point.clone())};
      show(psi = angle);
      world.updateWorldMatrix(true, false);
      const c = Math.cos(angle), s = Math.sin(angle), flapped = (out - motion.hinge) * Math.sin(harmonic(motion.flap, angle)), far = Math.max(.52 * radius, 2.7);  // Beyond the camera's near plane.
      const at = (x, y, z) => point.clone().set(x * c - y * s, x * s + y * c, z + flapped).applyMatrix4(world.matrixWorld);
      const from = at(out - .6 * far, -far, .5 * far), to = at(out + .12 * far, .1 * far, -.32 * far);  // The section above the card.
      control.setLookAt(from.x, from.y, from.z, to.x, to.y, to.z, !calm.matches && performance.now() - (seat.since ??= performance.now()) < 900);
    },
    async leave() {
      const back = seat, control = viewer()?.cameraControl;
      seat = null;
      if (!back || !control) return;
      heard = mark = null;
      await Promise.race([control.setLookAt(...back.from.toArray(), ...back.to.toArray(), !calm.matches), new Promise(done => setTimeout(done, 1500))]);
      await new Promise(done => setTimeout(done, 200));  // Until the server has heard where the camera is.
    },
    // A second rotor at the same place turns with it.
    compare(other) { compared = other; },
    // Blades and head of any rotor at ψ, once.
    pose(of, at) { pose(of, at); viewer().requestRender?.(); },
    // The camera goes there smoothly, unless less motion was asked for.
    look(position, target) {
      const control = viewer()?.cameraControl, world = viewer()?.nodeRefFromName?.['/airframe']?.parent;
      if (!control || !world) return;
      world.updateWorldMatrix(true, false);
      const [from, to] = [position, target].map(at => world.position.clone().set(...at).applyMatrix4(world.matrixWorld));
      control.setLookAt(from.x, from.y, from.z, to.x, to.y, to.z, !calm.matches);
      viewer().requestRender?.();
    },
    stop() { motion = heard = mark = null; },
    get psi() { return psi; },
    // Whether a graphics card draws; null: not known yet.
    get sharp() { return sharp; },
  };
  setInterval(() => { dress(); light(); go(); }, 500);
})()
