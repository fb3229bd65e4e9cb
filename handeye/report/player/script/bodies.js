import { add, dot, length, rotated, sides, subtract } from "./geometry.js";
import { rowsOf, summed } from "./packed.js";
import { DEPTH } from "./shaders.js";

const SMALL = 20; // points; a body whose radius in the picture is smaller is drawn with its coarse mesh
const STILL = 40; // after this number of pictures without movement, a body counts as still
const SHIFT = 2e-5, TURN = 1e-5; // greater changes count as movement: m, and components of a quaternion

// The bodies of a scene, with their shapes and present poses.
export class Bodies {
  constructor(graphics, { header, array }) {
    this.graphics = graphics;
    this.list = header.bodies.map(body => ({ ...body, mesh: header.meshes[body.mesh], pose: null, since: 0 }));
    this.named = new Map(this.list.map(body => [body.name, body]));
    this.world = this.list.find(body => body.mesh.parts);
    this.inOrder = [...this.list].sort((a, b) => !!a.mesh.parts - !!b.mesh.parts); // the world is drawn last
    if (this.world) this.world.pose = [0, 0, 0, 1, 0, 0, 0];
    this.pictures = 0;
    this.surfaces = graphics.surfaces(...corners(array), summed(array("triangles")));
    this.depth = graphics.program(DEPTH);
  }

  // Set the pose of a body (null if it is hidden). Returns true if the pose has changed.
  put(name, pose) {
    const body = this.named.get(name);
    if (!body || !moved(body.pose, pose)) return false;
    body.pose = pose;
    body.since = this.pictures;
    return true;
  }

  // Count a picture. Returns tests for still and moving bodies, and a text that changes when their results change.
  count() {
    this.pictures++;
    const first = this.pictures <= STILL;
    const still = body => (first ? !body.since : this.pictures - body.since > STILL);
    const key = this.list.map(body => (body.pose ? +still(body) : 2)).join("");
    return { still, moving: body => !still(body), key };
  }

  drawDepth(view, which) {
    const { gl } = this.graphics;
    this.begin(this.depth, view);
    for (const body of this.inOrder) {
      if (body.pose && which(body)) this.drawBody(this.depth, body, body.mesh.coarse ?? body.mesh.fine);
    }
    gl.bindVertexArray(null);
  }

  // Draw the bodies in sight with a shader program. `points`: size in the picture of a metre at a distance of a metre.
  draw(uniforms, { eye, matrix, points }, which) {
    const planes = sides(matrix);
    this.begin(uniforms, matrix);
    for (const body of this.inOrder) {
      if (!body.pose || !which(body)) continue;
      const [x, y, z, radius] = body.mesh.ball, middle = add(rotated(body.pose.slice(3), [x, y, z]), body.pose);
      if (body !== this.world && planes.some(plane => dot(plane, middle) + plane[3] < -radius)) continue;
      const small = radius * points < SMALL * length(subtract(middle, eye));
      this.drawBody(uniforms, body, (small && body.mesh.coarse) || body.mesh.fine);
    }
  }

  // Return the displayed name of the body, or of the part of the world, at one point of a picture; null if none.
  pick(matrix) {
    const { graphics } = this, { gl } = graphics, names = [], ink = new Uint8Array(4);
    graphics.into(graphics.target("pick", 1, 1, [gl.RGBA8], gl.DEPTH_COMPONENT24), 1, 1);
    gl.clearColor(0, 0, 0, 0);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
    this.begin(this.depth, matrix);
    for (const body of this.inOrder) {
      if (!body.pose) continue;
      for (const [name, ...range] of body.mesh.parts ?? [[body.label, ...body.mesh.fine]]) {
        names.push(name);
        gl.uniform4f(this.depth.ink, (names.length & 255) / 255, (names.length >> 8) / 255, 0, 1);
        this.drawBody(this.depth, body, range);
      }
    }
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, ink);
    return names[ink[0] + 256 * ink[1] - 1] ?? null;
  }

  begin(uniforms, view) {
    const { gl } = this.graphics;
    gl.useProgram(uniforms.program);
    gl.bindVertexArray(this.surfaces);
    gl.uniformMatrix4fv(uniforms.view, false, view);
  }

  drawBody(uniforms, { pose, mesh }, [first, count]) {
    const { gl } = this.graphics, [x, y, z, ...turn] = pose;
    gl.uniform3f(uniforms.place, x, y, z);
    gl.uniform4fv(uniforms.turn, turn);
    gl.uniform4fv(uniforms.scale, mesh.scale);
    gl.drawElements(gl.TRIANGLES, count, gl.UNSIGNED_INT, first * 4);
  }
}

function moved(old, now) {
  if (!old || !now) return old !== now;
  return now.some((x, i) => Math.abs(x - old[i]) > (i < 3 ? SHIFT : TURN));
}

// Points and normals for the graphics card, with four numbers per corner. The third number of a normal is its material.
function corners(array) {
  const [steep, materials] = [array("normals"), array("materials")], packed = rowsOf(array("points"), 3);
  const count = materials.length;
  const points = new Uint16Array(count * 4), normals = new Int8Array(count * 4);
  for (let i = 0; i < count; i++) {
    points.set(packed.subarray(i * 3, i * 3 + 3), i * 4);
    normals.set([steep[i], steep[count + i], materials[i]], i * 4);
  }
  return [points, normals];
}
