import { VERSION } from "./shaders.js";

// A WebGL 2 context and the objects made in it.
export class Graphics {
  constructor(canvas) {
    // With an alpha channel, pictures can be copied to the canvas unchanged.
    this.gl = canvas.getContext("webgl2", { antialias: false, alpha: true, powerPreference: "high-performance" });
    if (!this.gl) throw new Error("This browser offers no WebGL 2.");
    this.floats = ["EXT_color_buffer_float", "EXT_color_buffer_half_float"].some(name => this.gl.getExtension(name));
    this.targets = new Map();
    this.nothing = this.gl.createVertexArray();
  }

  // A shader program, with the locations of its uniforms by name.
  program([vertex, fragment]) {
    const { gl } = this, program = gl.createProgram();
    for (const [kind, source] of [[gl.VERTEX_SHADER, vertex], [gl.FRAGMENT_SHADER, fragment]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, VERSION + source);
      gl.compileShader(shader);
      gl.attachShader(program, shader);
    }
    gl.linkProgram(program);
    if (!gl.getProgramParameter(program, gl.LINK_STATUS) && !gl.isContextLost()) {
      const told = gl.getAttachedShaders(program).map(shader => gl.getShaderInfoLog(shader)).join("");
      throw new Error(`The view cannot be drawn here: ${told || gl.getProgramInfoLog(program)}`);
    }
    const uniforms = { program };
    for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); i++) {
      const { name } = gl.getActiveUniform(program, i);
      uniforms[name] = gl.getUniformLocation(program, name);
    }
    return uniforms;
  }

  // Triangles, given by points (four whole numbers per corner) and normals (four bytes per corner).
  surfaces(points, normals, triangles) {
    const { gl } = this, array = gl.createVertexArray();
    const filled = (kind, values) => {
      gl.bindBuffer(kind, gl.createBuffer());
      gl.bufferData(kind, values, gl.STATIC_DRAW);
    };
    gl.bindVertexArray(array);
    filled(gl.ARRAY_BUFFER, points);
    gl.vertexAttribPointer(0, 3, gl.UNSIGNED_SHORT, false, 8, 0);
    filled(gl.ARRAY_BUFFER, normals);
    gl.vertexAttribPointer(1, 4, gl.BYTE, false, 4, 0);
    gl.enableVertexAttribArray(0);
    gl.enableVertexAttribArray(1);
    filled(gl.ELEMENT_ARRAY_BUFFER, triangles);
    return array;
  }

  texture(format, width, height, filter = this.gl.NEAREST) {
    const { gl } = this, texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, format, width, height);
    for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, filter);
    for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
    return texture;
  }

  // A table of numbers for the shaders.
  table(rows, width) {
    const { gl } = this, texture = this.texture(gl.RGBA32F, width, rows.length);
    gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, width, rows.length, gl.RGBA, gl.FLOAT, new Float32Array(rows.flat()));
    return texture;
  }

  // `count` square grey pictures, which repeat across a surface. If there are none, the surface is white.
  grains(levels, count) {
    const { gl } = this, texture = gl.createTexture(), kind = gl.TEXTURE_2D_ARRAY;
    const side = count ? Math.sqrt(levels.length / count) : 1;
    gl.bindTexture(kind, texture);
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 1);
    const bytes = new Uint8Array(count ? levels : [255]);
    gl.texImage3D(kind, 0, gl.R8, side, side, Math.max(count, 1), 0, gl.RED, gl.UNSIGNED_BYTE, bytes);
    gl.generateMipmap(kind);
    gl.texParameteri(kind, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_NEAREST); // half the work of blending two levels
    return texture;
  }

  // A shadow map: the distances of the surfaces nearest to a lamp.
  shadowMap(size) {
    const { gl } = this, frame = gl.createFramebuffer();
    const texture = this.texture(gl.DEPTH_COMPONENT16, size, size, gl.LINEAR);
    gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_COMPARE_MODE, gl.COMPARE_REF_TO_TEXTURE);
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.DEPTH_ATTACHMENT, gl.TEXTURE_2D, texture, 0);
    return { frame, texture, size };
  }

  // Pictures to draw into and to read afterwards. They are made again when the size changes. `depth`: format, or null.
  target(name, width, height, formats, depth = null) {
    const known = this.targets.get(name);
    if (known?.width === width && known.height === height) return known;
    if (known) this.release(known);
    const { gl } = this, frame = gl.createFramebuffer();
    const textures = formats.map(format => this.texture(format, width, height));
    if (depth) textures.push(this.texture(depth, width, height));
    gl.bindFramebuffer(gl.FRAMEBUFFER, frame);
    textures.forEach((texture, i) => {
      const place = i < formats.length ? gl.COLOR_ATTACHMENT0 + i : gl.DEPTH_ATTACHMENT;
      gl.framebufferTexture2D(gl.FRAMEBUFFER, place, gl.TEXTURE_2D, texture, 0);
    });
    gl.drawBuffers(formats.map((_, i) => gl.COLOR_ATTACHMENT0 + i));
    const target = { width, height, frame, textures };
    this.targets.set(name, target);
    return target;
  }

  release({ frame, textures }) {
    this.gl.deleteFramebuffer(frame);
    for (const texture of textures) this.gl.deleteTexture(texture);
  }

  // From now on, draw into a target or, if there is none, into the canvas.
  into(target, width, height) {
    this.gl.bindFramebuffer(this.gl.FRAMEBUFFER, target?.frame ?? null);
    this.gl.viewport(0, 0, width, height);
  }

  bind(unit, texture, location, kind = this.gl.TEXTURE_2D) {
    this.gl.activeTexture(this.gl.TEXTURE0 + unit);
    this.gl.bindTexture(kind, texture);
    this.gl.uniform1i(location, unit);
  }

  // Draw one triangle that covers the whole picture.
  whole() {
    this.gl.bindVertexArray(this.nothing);
    this.gl.drawArrays(this.gl.TRIANGLES, 0, 3);
  }

  // Wait until the graphics card has drawn everything.
  finish() {
    this.gl.readPixels(0, 0, 1, 1, this.gl.RGBA, this.gl.UNSIGNED_BYTE, new Uint8Array(4));
  }
}
