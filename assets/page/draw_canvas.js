// Drawing with Canvas 2D if WebGL 2 is unavailable: the same picture, more slowly.

const cssColour = (bytes, at) => `rgba(${bytes[at]}, ${bytes[at + 1]}, ${bytes[at + 2]}, ${bytes[at + 3] / 255})`;

function canvasDrawer(canvas) {
  const pen = canvas.getContext("2d");
  let shapes = null;

  const isSeen = (px, py, reach) => px > -reach && px < canvas.width + reach && py > -reach && py < canvas.height + reach;

  const drawDisc = (i, shift, ratio) => {
    const [x, y] = project(shapes.discs[4 * i] + shift, shapes.discs[4 * i + 1]);
    const radius = camera.scale * shapes.discs[4 * i + 2] * ratio;
    if (!isSeen(x * ratio, y * ratio, radius)) return;
    const rim = Math.min(0.18 * radius, 2 * ratio);
    pen.beginPath();
    pen.arc(x * ratio, y * ratio, radius, 0, 2 * Math.PI);
    pen.fillStyle = cssColour(shapes.looks, 8 * i + 4);
    pen.fill();
    pen.beginPath();
    pen.arc(x * ratio, y * ratio, radius - rim, 0, 2 * Math.PI);
    pen.fillStyle = cssColour(shapes.looks, 8 * i);
    pen.fill();
    if (shapes.discs[4 * i + 3]) hatchDisc(x * ratio, y * ratio, radius - rim, cssColour(shapes.looks, 8 * i + 4));
  };

  const hatchDisc = (x, y, radius, colour) => {
    pen.save();
    pen.clip();
    pen.strokeStyle = colour;
    pen.lineWidth = Math.max(0.24 * radius, 0.5);
    for (const offset of [-0.8, 0, 0.8]) {
      pen.beginPath();
      pen.moveTo(x - radius + offset * radius, y + radius + offset * radius);
      pen.lineTo(x + radius + offset * radius, y - radius + offset * radius);
      pen.stroke();
    }
    pen.restore();
  };

  const drawLine = (k, shift, ratio) => {
    const [x0, y0, x1, y1, half] = shapes.lines.numbers.subarray(5 * k, 5 * k + 5);
    const [fromX, fromY] = project(x0 + shift, y0), [toX, toY] = project(x1 + shift, y1);
    if (!isSeen(fromX * ratio, fromY * ratio, 2 * camera.scale * ratio)) return;
    pen.strokeStyle = cssColour(shapes.lines.colours, 4 * k);
    pen.lineWidth = 2 * Math.max(camera.scale * half, 0.35) * ratio;
    pen.lineCap = "round";
    pen.beginPath();
    pen.moveTo(fromX * ratio, fromY * ratio);
    pen.lineTo(toX * ratio, toY * ratio);
    pen.stroke();
  };

  const drawAll = (ratio) => {
    for (const shift of shifts) {
      for (let i = 0; i < bed.grains; ++i) drawDisc(i, shift, ratio);
      for (let k = 0; k < shapes.lines.count; ++k) drawLine(k, shift, ratio);
    }
  };

  /** Clips to the bed between its edges or, if `outside`, to the rest of the picture. */
  const clipToBed = (ratio, outside) => {
    pen.beginPath();
    if (outside) pen.rect(0, 0, canvas.width, canvas.height);
    const far = 10 * bed.length;
    [[0, -far], [bed.length, -far], [bed.length, far], [0, far]].forEach(([x, y], k) => {
      const [px, py] = project(x, y);
      if (k === 0) pen.moveTo(px * ratio, py * ratio);
      else pen.lineTo(px * ratio, py * ratio);
    });
    pen.closePath();
    pen.clip("evenodd");
  };

  return {
    name: "Canvas 2D",
    set(next) {
      shapes = next;
    },
    draw(ratio) {
      pen.clearRect(0, 0, canvas.width, canvas.height);
      if (!bed.periodic) return drawAll(ratio);
      for (const outside of [true, false]) {
        pen.save();
        clipToBed(ratio, outside);
        pen.globalAlpha = outside ? faded : 1;
        drawAll(ratio);
        pen.restore();
      }
    },
  };
}
