// @ts-check
// The scene's own script in the page: gloss of surfaces, and the turning rotor.
(() => {
  const {clamp, lerp, distance, calm, drag, viewer, node, setPose} = Common, TURN = 2 * Math.PI;
  let surfaces = {}, lit = {};

  // Pictures seen from a low angle stay sharp with anisotropic filtering, which a graphics card gives for nothing.
  const hardware = () => {
    const gl = viewer().canvas?.getContext('webgl2'), info = gl?.getExtension('WEBGL_debug_renderer_info');
    return Boolean(info) && !/swiftshader|llvmpipe|software/i.test(gl.getParameter(info.UNMASKED_RENDERER_WEBGL));
  };
  let sharp = null;
  const drawing = () => viewer().scene.__r3f.root.getState();

  // Where software draws, the picture has half as many pixels each way while something is dragged: so it keeps up.
  drag(window, '*', (_, {clientX, clientY}) => {
    if (sharp !== false) return null;
    const {setDpr, viewport: {dpr}} = drawing(), press = [clientX, clientY];
    let shrunk = false;
    return {
      move(event) {
        if (shrunk || distance([event.clientX, event.clientY], press) < 4) return;
        shrunk = true;
        setDpr(dpr / 2);
      },
      end() { if (shrunk) setDpr(dpr); },
    };
  }, true);

  // Materials come and go with their nodes, so they are looked at again and again; a dressed one is left alone.
  // `change` gives true for a material that it has changed.
  function changeMaterials(wishes, change) {
    let changed = false;
    for (const [name, wish] of Object.entries(wishes))
      node(name)?.traverse?.(({isMesh, material}) => {
        if (isMesh && material?.userData && change(material, wish)) changed = true;
      });
    if (changed) viewer().requestRender?.();
  }
  function dress() {
    sharp ??= viewer()?.canvas ? hardware() : null;
    changeMaterials(surfaces, (material, {flat, roughness = 1, metalness = 0}) => {
      const {map, userData} = material, blurred = flat && sharp && map && map.anisotropy < 8;
      if (blurred) Object.assign(map, {anisotropy: 8, needsUpdate: true});
      if (userData.dressed || (flat ? !map : material.roughness === undefined)) return blurred;
      Object.assign(material, flat ? {depthWrite: false} : {roughness, metalness});
      return userData.dressed = true;
    });
  }
  // Pieces that shine by themselves: [colour, strength] by node. Looked at again and again for the same reason.
  function light() {
    changeMaterials(lit, (material, [colour, strength]) => {
      const wish = `${colour} ${strength}`;
      if (!material.emissive || material.userData.lit === wish) return false;
      material.emissive.set(colour);
      material.emissiveIntensity = 0.9 * strength;
      material.userData.lit = wish;
      return true;
    });
  }

  // Turned by psi about the shaft, flapped about the hinge, then pitched: R_z(ψ) R_y(−β) R_x(θ).
  function place(name, angle, flap, pitch, hinge) {
    const halves = [angle / 2, -flap / 2, pitch / 2];
    const [ca, cb, cc] = halves.map(Math.cos), [sa, sb, sc] = halves.map(Math.sin);
    setPose(name, [
      ca * cb * cc + sa * sb * sc, ca * cb * sc - sa * sb * cc,
      ca * sb * cc + sa * cb * sc, sa * cb * cc - ca * sb * sc,
    ], [hinge * Math.cos(angle), hinge * Math.sin(angle), 0]);
  }
  // Of 1, cos ψ, sin ψ, cos 2ψ, …
  const harmonic = ([mean, ...waves], angle) =>
    waves.reduce((sum, size, k) => sum + size * (k % 2 ? Math.sin : Math.cos)((1 + (k >> 1)) * angle), mean);
  function pose({root, blades, flap, pitch, hinge}, at) {
    for (let k = 0; k < blades; k++) {
      const angle = at + TURN * k / blades;
      place(`${root}/blade_${k}`, angle, harmonic(flap, angle), harmonic(pitch, angle), hinge);
    }
    place(`${root}/head`, at, 0, 0, 0);
  }
  function show(at) {
    pose(motion, at);
    if (compared) pose(compared, at);
    trail(at);
    viewer().requestRender?.();
  }

  // Tip vortices are moved point by point: behind a flying rotor they do not turn as a whole. What left the tip at an
  // azimuth has an age [rad].
  function trail(at) {
    const {blades, hinge, flap, radius: tip, path: {along, turns, points, radius, sink}} = motion;
    const pieces = points - 1, last = radius.length - 1;
    const point = (age, azimuth) => {
      const of = last * age / (TURN * turns), i = Math.min(Math.floor(of), last - 1), share = of - i;
      const turn = azimuth / TURN * sink.length, column = Math.floor(turn);
      const depth = n => {
        const row = sink[((n % sink.length) + sink.length) % sink.length];
        return lerp(row[i], row[i + 1], share);
      };
      const r = lerp(radius[i], radius[i + 1], share), sunk = lerp(depth(column), depth(column + 1), turn - column);
      return [
        tip * (r * Math.cos(azimuth) + along * age), tip * r * Math.sin(azimuth),
        (tip - hinge) * harmonic(flap, azimuth) - tip * sunk,
      ];
    };
    node(motion.vortices)?.traverse?.(part => {
      const data = part.geometry?.attributes?.instanceStart?.data;
      if (data?.array?.length !== 6 * blades * pieces) return;
      for (let blade = 0; blade < blades; blade++) for (let k = 0; k <= pieces; k++) {
        const age = TURN * turns * k / pieces, here = point(age, at + TURN * blade / blades - age);
        if (k < pieces) data.array.set(here, 6 * (blade * pieces + k));
        if (k) data.array.set(here, 6 * (blade * pieces + k) - 3);
      }
      data.needsUpdate = true;
    });
  }

  // The server says ten or twenty times a second where the reference blade is; in between the page goes on at that rate
  // and closes what is left between the two. Whoever asked for less motion sees the rotor at rest in steps of 30° or
  // more, at most two a second.
  let motion = null, compared = null, seat = null, spin = 0, heard = null, mark = null, rate = 0, psi = 0;
  const shortest = angle => angle - TURN * Math.round(angle / TURN);
  const LATE = 400;  // [ms] After which nothing more is expected of the server.
  let stepping = false, before = 0, stepped = 0;
  // Frames are asked for only while something turns; in software, where each keeps the processors busy, no rotor turns
  // by itself.
  const follows = now => heard && !(heard.still && now - heard.at > LATE);
  const turning = now => motion && !seat && (follows(now) || (spin && sharp && !calm.matches));
  function go() {
    const now = performance.now();
    if (stepping || !turning(now)) return;
    stepping = true;
    before = now;
    requestAnimationFrame(step);
  }
  function step(now) {
    stepping = turning(now);
    if (!stepping) return;
    requestAnimationFrame(step);
    const passed = clamp((now - before) / 1000, 0, 0.5), own = Math.min(passed, 0.1);
    before = now;
    if (!follows(now)) { show(psi += spin * own); return; }
    const since = (now - heard.at) / 1000, going = since < 0.3 ? rate : 0, last = psi;
    const aim = heard.psi + rate * Math.min(since, 0.3);
    if (calm.matches) {
      heard.still = Math.abs(shortest(aim - psi)) < Math.PI / 6;
      if (heard.still || now - stepped < 500) return;
      psi = aim;
      stepped = now;
    } else {
      psi += going * own + shortest(aim - psi - going * own) * Math.min(1, 5 * passed);
      heard.still = Math.abs(psi - last) < 1e-4;
    }
    show(psi);
  }

  const smooth = t => t * t * t * (t * (6 * t - 15) + 10);
  let flight = 0;

  // Whether it is drawn: the browser may have no WebGL, or take it away for a time.
  let lost = false;
  for (const [event, gone] of /** @type {const} */ ([['webglcontextlost', true], ['webglcontextrestored', false]]))
    addEventListener(event, ({target}) => {
      if (target !== viewer()?.canvas) return;
      lost = gone;
      RX.send('scene', rotorScene.drawn);
      if (!lost) viewer().requestRender?.();
    }, true);

  window.rotorScene = {
    get drawn() {
      if (lost) return 'lost';
      return document.createElement('canvas').getContext('webgl2')?.isContextLost() ? 'none' : 'drawn';
    },
    // Camera and a lifted blade fly to where the server puts them: the camera from where it is, the blade from the
    // reference blade to where it is held, or back. `offset`: of the blade's origin from the flap hinge, along it.
    lift(name, out, duration, held, offset) {
      const client = viewer(), control = client.cameraControl, own = ++flight, begun = performance.now();
      if (calm.matches || !control || !client.camera) return;
      const vector = () => client.camera.position.clone();
      const look = () => [control.getPosition(vector()), control.getTarget(vector())];
      const start = look();
      let last = start, goal = null;
      const onRotor = () => {
        const root = node(name)?.parent, blade = node('/rotor/blade_0');
        if (!root || !blade) return null;
        blade.updateWorldMatrix(true, false);
        const turn = blade.quaternion.clone(), origin = vector();
        root.matrixWorld.clone().invert().multiply(blade.matrixWorld).decompose(origin, turn, vector());
        return {place: origin.add(vector().set(offset, 0, 0).applyQuaternion(turn)), turn};
      };
      const frame = now => {
        if (own !== flight) return;
        const done = smooth(Math.min(1, (now - begun) / duration)), here = look();
        if (!goal || here.some((spot, k) => spot.distanceTo(last[k]) > 1e-3)) goal = here;
        const [from, to] = start.map((spot, k) => spot.clone().lerp(goal[k], done).toArray());
        control.setLookAt(...from, ...to, false);
        last = look();
        const blade = onRotor();
        if (blade) {
          const share = out ? done : 1 - done, [w, x, y, z] = held.wxyz;
          const turn = blade.turn.slerp(blade.turn.clone().set(x, y, z, w), share);
          const position = blade.place.lerp(vector().set(...held.position), share).toArray();
          setPose(name, [turn.w, turn.x, turn.y, turn.z], position);
        }
        client.requestRender?.();
        if (done < 1) requestAnimationFrame(frame);
      };
      frame(begun);
    },
    // Something hides the scene wholly: nothing of it is drawn until it is seen again.
    hide(hidden) {
      const {setFrameloop, invalidate} = drawing();
      viewer().canvas.style.visibility = hidden ? 'hidden' : '';
      setFrameloop(hidden ? 'never' : 'demand');
      if (!hidden) invalidate();
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
      else if (at - mark.at > 250) {
        rate = 1000 * shortest(angle - mark.psi) / (at - mark.at);
        mark = {psi: angle, at};
      }
      heard = {psi: angle, at};
      go();
    },
    // The reference blade at ψ [rad], and the camera with its section, as `RidePart` says, above a card that covers so
    // much of the canvas. The page learns where the horizon is on the canvas [%]. `leave` flies back, or leaves the
    // camera to the server.
    ride(angle, {out, eye, look, view}, covered) {
      const control = viewer()?.cameraControl, blade = node('/rotor/blade_0'), world = blade?.parent;
      if (!motion || !control || !world) return;
      const point = blade.position.clone(), now = performance.now(), {camera} = viewer();
      const [here, there] = [control.getPosition(point.clone()), control.getTarget(point.clone())];
      seat ??= {from: here, to: there, since: now, fov: camera.fov};
      show(psi = angle);
      world.updateWorldMatrix(true, false);
      const c = Math.cos(angle), s = Math.sin(angle);
      const flapped = (out - motion.hinge) * Math.sin(harmonic(motion.flap, angle));
      const at = ([more, y, z], x = out + more) =>
        point.clone().set(x * c - y * s, x * s + y * c, z + flapped).applyMatrix4(world.matrixWorld);
      const from = at(eye), to = at(look), along = to.clone().sub(from).normalize();
      // What would fill the canvas is drawn smaller, above the card, though not so small that its edges are distorted.
      const half = Math.tan(view * Math.PI / 360) / (1 - covered) ** .75;
      const {clientWidth: width, clientHeight: height} = viewer().canvas;
      camera.fov = 2 * Math.atan(half) * 180 / Math.PI;
      camera.setViewOffset(width, height, 0, covered / 2 * height, width, height);
      control.setLookAt(...from.toArray(), ...to.toArray(), !calm.matches && now - seat.since < 900);
      const rise = Math.tan(Math.asin(along.dot(camera.up))) / half, horizon = 50 + 50 * (rise - covered);
      document.documentElement.style.setProperty('--rx-horizon', `${horizon.toFixed(1)}%`);
    },
    async leave(flies) {
      const back = seat, control = viewer()?.cameraControl;
      seat = null;
      if (!back || !control) return;
      viewer().camera.fov = back.fov;
      viewer().camera.clearViewOffset();
      heard = mark = null;
      if (!flies) return;
      const wait = time => new Promise(done => setTimeout(done, time));
      await Promise.race([control.setLookAt(...back.from.toArray(), ...back.to.toArray(), !calm.matches), wait(1500)]);
      await wait(200);  // Until the server has heard where the camera is.
    },
    // A second rotor at the same place turns with it.
    compare(other) { compared = other; },
    // Blades and head of any rotor at ψ, once.
    pose(of, at) { pose(of, at); viewer().requestRender?.(); },
    // The camera goes there smoothly, unless less motion was asked for.
    look(position, target) {
      const control = viewer()?.cameraControl, world = node('/airframe')?.parent;
      if (!control || !world) return;
      world.updateWorldMatrix(true, false);
      const [from, to] = [position, target].map(at =>
        world.position.clone().set(...at).applyMatrix4(world.matrixWorld).toArray());
      control.setLookAt(...from, ...to, !calm.matches);
      viewer().requestRender?.();
    },
    stop() { motion = heard = mark = null; },
    get psi() { return psi; },
    // Whether a graphics card draws; null: not known yet.
    get sharp() { return sharp; },
  };
  setInterval(() => { dress(); light(); go(); }, 500);
})();
