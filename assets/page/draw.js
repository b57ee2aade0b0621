// Drawing of the bed, pixel by pixel: without a GPU this is many times as fast as WebGL or the paths of Canvas 2D.

/** Shifts at which the bed is drawn; a periodic bed includes its neighbouring images. */
const shifts = bed.periodic ? [0, -bed.length, bed.length] : [0];

const faded = 0.28;  // opacity of the images beyond the edges of the period

/**
 * Draws the points within `reach` px of a segment: a line or, if its ends coincide, a disc. `look` has, from `first` on, four bytes
 * of the fill and four of the rim, which is `rim` px wide; `hatch` is the period of a hatching, px, or 0.
 */
function stamp({ words, width, height }, x0, y0, x1, y1, reach, rim, look, first, hatch) {
  const left = Math.max(0, Math.floor(Math.min(x0, x1) - reach)), right = Math.min(width, Math.ceil(Math.max(x0, x1) + reach));
  const top = Math.max(0, Math.floor(Math.min(y0, y1) - reach)), bottom = Math.min(height, Math.ceil(Math.max(y0, y1) + reach));
  if (left >= right || top >= bottom) return;
  const dx = x1 - x0, dy = y1 - y0, square = dx * dx + dy * dy, border = (reach + 0.5) ** 2, side = Math.sqrt(border * square);
  const red = look[first], green = look[first + 1], blue = look[first + 2], opacity = look[first + 3] / 255;
  const rimRed = look[first + 4], rimGreen = look[first + 5], rimBlue = look[first + 6], rimOpacity = look[first + 7] / 255;
  // Within this distance nothing of the rim, of the edge, and of what lies below is seen.
  const solid = look[first + 3] === 255 && hatch === 0 ? Math.max(0, reach - rim - 0.5) ** 2 : 0;
  const plain = (255 << 24) | (blue << 16) | (green << 8) | red;
  for (let py = top; py < bottom; ++py) {
    const down = py + 0.5 - y0;
    // The part of the row between the two sides of a line, or within a disc.
    const middle = dy === 0 ? x0 : x0 + (down * dx) / dy;
    const half = square === 0 ? Math.sqrt(Math.max(0, border - down * down)) : dy === 0 ? right : side / Math.abs(dy);
    const from = Math.max(left, Math.ceil(middle - half - 0.5)), to = Math.min(right, Math.floor(middle + half + 0.5));
    for (let px = from, at = py * width + from; px < to; ++px, ++at) {
      let x = px + 0.5 - x0, y = down;
      if (square > 0) {
        const along = Math.min(1, Math.max(0, (x * dx + y * dy) / square));
        x -= along * dx;
        y -= along * dy;
      }
      const distance = x * x + y * y;
      if (distance >= border) continue;
      if (distance < solid) {
        words[at] = plain;
        continue;
      }
      const depth = reach + 0.5 - Math.sqrt(distance), outer = depth < 1 ? depth : 1;
      let inner = depth < rim ? 0 : depth < rim + 1 ? depth - rim : 1;
      // Hatching is continuous from grain to grain, as in the shaders of Talus.
      if (hatch > 0) inner *= 1 - Math.min(1, Math.max(0, (0.15 - Math.abs((((px + py) * Math.SQRT1_2) / hatch) % 1 - 0.5)) * hatch + 0.5));
      const word = words[at];
      let fill = inner * opacity, edge = (outer - inner) * rimOpacity, under = (1 - fill - edge) * (word >>> 24) / 255;
      const sum = fill + edge + under, share = sum > 0 ? 1 / sum : 0;
      fill *= share;
      edge *= share;
      under *= share;
      const r = fill * red + edge * rimRed + under * (word & 255) + 0.5, g = fill * green + edge * rimGreen + under * ((word >> 8) & 255) + 0.5;
      const b = fill * blue + edge * rimBlue + under * ((word >> 16) & 255) + 0.5;
      words[at] = ((255 * sum + 0.5) << 24) | (b << 16) | (g << 8) | r;
    }
  }
}

/** Makes what lies beyond the edges of the period faint. */
function fadeImages(pen, { width, height }, ratio) {
  const far = 10 * bed.length;
  pen.globalCompositeOperation = "destination-out";
  pen.fillStyle = `rgba(0, 0, 0, ${1 - faded})`;
  pen.beginPath();
  pen.rect(0, 0, width, height);
  [[0, -far], [bed.length, -far], [bed.length, far], [0, far]].forEach(([x, y], k) => {
    const [px, py] = project(x, y);
    pen[k === 0 ? "moveTo" : "lineTo"](px * ratio, py * ratio);
  });
  pen.fill("evenodd");
  pen.globalCompositeOperation = "source-over";
}

/** Draws a frame on a canvas: the looks of its grains and its lines, at `ratio` px of the canvas per px of the page. */
function drawBed(canvas, frame, looks, lines, ratio) {
  const { width, height } = canvas, image = new ImageData(width, height), pen = canvas.getContext("2d");
  const picture = { width, height, words: new Int32Array(image.data.buffer) };
  const places = centres(frame), sizes = radii();
  const scale = camera.scale * ratio, c = scale * Math.cos(camera.turn), s = scale * Math.sin(camera.turn);
  for (const shift of shifts) {
    const left = camera.originX * ratio + c * shift, top = camera.originY * ratio + s * shift;
    const toX = (x, y) => left + c * x + s * y, toY = (x, y) => top + s * x - c * y;
    for (let i = 0; i < bed.grains; ++i) {
      const x = toX(places[2 * i], places[2 * i + 1]), y = toY(places[2 * i], places[2 * i + 1]), radius = scale * sizes[i];
      stamp(picture, x, y, x, y, radius, Math.min(0.18 * radius, 2 * ratio), looks, 8 * i, i < bed.free ? 0 : Math.max(0.8 * radius, 3 * ratio));
    }
    for (const { x0, y0, x1, y1, half, look } of lines)
      stamp(picture, toX(x0, y0), toY(x0, y0), toX(x1, y1), toY(x1, y1), Math.max(scale * half, 0.35 * ratio), 0, look, 0, 0);
  }
  pen.putImageData(image, 0, 0);
  if (bed.periodic) fadeImages(pen, canvas, ratio);
}
