import { disc, halton, inverse } from "./geometry.js";
import { DRAFT, FINE, KEPT, RECALLED, WEIGHED } from "./shaders.js";

const APERTURE = 0.002; // radius of the lens, m
const HORIZON = 0.15; // sine of the sky's least elevation; lower light would cast shadows on the walls
const DARK = [0.13, 0.13, 0.135, 1];

// Draws the bodies, either as a draft or as one of many exposures, which are averaged.
export class Picture {
  constructor(graphics, bodies, shadows, materials, grain) {
    Object.assign(this, { graphics, bodies, shadows, materials, grain });
    const shaders = { DRAFT, KEPT, RECALLED, WEIGHED };
    for (const [name, shader] of Object.entries(shaders)) this[name] = graphics.program(shader);
    this.last = this.keptFor = null;
    graphics.gl.enable(graphics.gl.DEPTH_TEST);
    graphics.gl.depthFunc(graphics.gl.LEQUAL);
  }

  // While the camera is still, a stored picture (with depth) shows the still bodies, and only moving bodies are drawn.
  draft(camera, width, height) {
    const { graphics, shadows } = this, light = shadows.light(), seen = camera.seen(width, height);
    const { still, moving, key } = this.bodies.count();
    shadows.drawDraft(light, still, moving, key);
    const sight = [width, height, ...seen.matrix].join();
    if (sight === this.last) {
      this.keep(light, seen, still, key + sight, width, height);
      graphics.into(null, width, height);
      this.recall(light, seen);
      this.paint(this.DRAFT, light, seen, shadows.draft, moving);
    } else {
      graphics.into(null, width, height);
      this.clear();
      this.paint(this.DRAFT, light, seen, shadows.draft, () => true);
    }
    this.last = sight;
  }

  keep(light, seen, still, key, width, height) {
    const { gl } = this.graphics;
    const kept = this.graphics.target("kept", width, height, [gl.RGB10_A2, gl.RGB10_A2], gl.DEPTH_COMPONENT24);
    if (key === this.keptFor && kept === this.kept) return;
    this.keptFor = key;
    this.kept = kept;
    this.graphics.into(kept, width, height);
    this.clear();
    this.paint(this.KEPT, light, seen, null, still);
  }

  recall(light, seen) {
    const { graphics, RECALLED: uniforms } = this, { gl } = graphics, [around, lamplight, depth] = this.kept.textures;
    gl.useProgram(uniforms.program);
    graphics.bind(0, around, uniforms.around);
    graphics.bind(1, lamplight, uniforms.lamplight);
    graphics.bind(2, depth, uniforms.depth);
    graphics.bind(3, this.shadows.draft.texture, uniforms.shadow);
    gl.uniformMatrix4fv(uniforms.back, false, inverse(seen.matrix));
    gl.uniformMatrix4fv(uniforms.lampView, false, light.view);
    gl.uniform3fv(uniforms.lamp, light.lamp);
    gl.depthFunc(gl.ALWAYS);
    graphics.whole();
    gl.depthFunc(gl.LEQUAL);
    for (let unit = 0; unit < 4; unit++) graphics.bind(unit, null, null); // a drawing target must not be read
  }

  // Draw one of many exposures. Each uses a different point of the lamp, of the lens and of the sky.
  expose(camera, width, height, number) {
    const { graphics, shadows } = this, { gl } = graphics, i = number + 1;
    this.FINE ??= graphics.program(FINE);
    const light = shadows.light(disc(i, 2, 3)), lens = disc(i, 3, 5).map(x => x * APERTURE);
    const seen = camera.seen(width, height, [halton(i, 2) - 0.5, halton(i, 3) - 0.5], lens);
    shadows.drawFine(light);
    const high = HORIZON + (1 - HORIZON) * halton(i, 3), low = Math.sqrt(1 - high * high);
    const turn = 2 * Math.PI * halton(i, 2);
    const dome = [Math.cos(turn) * low, Math.sin(turn) * low, high];
    const domeView = shadows.drawDome(dome, shadows.lamp.at);
    const one = graphics.target("one", width, height, [gl.RGBA8], gl.DEPTH_COMPONENT24);
    graphics.into(one, width, height);
    this.clear();
    gl.useProgram(this.FINE.program);
    gl.uniform3fv(this.FINE.dome, dome);
    gl.uniformMatrix4fv(this.FINE.domeView, false, domeView);
    gl.uniform1f(this.FINE.number, number);
    graphics.bind(3, shadows.dome.texture, this.FINE.domeShadow);
    this.paint(this.FINE, light, seen, shadows.fine, () => true);
    this.gather(one, width, height, number === 0);
  }

  gather(one, width, height, first) {
    const { gl } = this.graphics;
    this.sum = this.graphics.target("sum", width, height, [gl.RGBA16F]);
    this.graphics.into(this.sum, width, height);
    if (first) {
      gl.clearColor(0, 0, 0, 0);
      gl.clear(gl.COLOR_BUFFER_BIT);
    }
    gl.enable(gl.BLEND);
    gl.blendFunc(gl.ONE, gl.ONE);
    this.weigh(one.textures[0], 1);
    gl.disable(gl.BLEND);
  }

  // Show the average of the exposures so far.
  develop(width, height, count) {
    this.graphics.into(null, width, height);
    this.weigh(this.sum.textures[0], 1 / count);
  }

  weigh(image, weight) {
    const { graphics, WEIGHED: uniforms } = this, { gl } = graphics;
    gl.useProgram(uniforms.program);
    graphics.bind(0, image, uniforms.image);
    gl.uniform1f(uniforms.weight, weight);
    gl.disable(gl.DEPTH_TEST);
    graphics.whole();
    gl.enable(gl.DEPTH_TEST);
    graphics.bind(0, null, null);
  }

  clear() {
    const { gl } = this.graphics;
    gl.clearColor(...DARK);
    gl.clear(gl.COLOR_BUFFER_BIT | gl.DEPTH_BUFFER_BIT);
  }

  paint(uniforms, light, seen, shadow, which) {
    const { graphics } = this, { gl } = graphics;
    gl.useProgram(uniforms.program);
    gl.uniform3fv(uniforms.eye, seen.eye);
    gl.uniform3fv(uniforms.lamp, light.lamp);
    gl.uniform3fv(uniforms.aim, light.aim);
    graphics.bind(0, this.materials, uniforms.materials);
    graphics.bind(1, this.grain, uniforms.grain, gl.TEXTURE_2D_ARRAY);
    if (shadow) {
      gl.uniformMatrix4fv(uniforms.lampView, false, light.view);
      graphics.bind(2, shadow.texture, uniforms.shadow);
    }
    this.bodies.draw(uniforms, seen, which);
  }
}
