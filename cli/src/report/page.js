"use strict";
(() => {
  const data = JSON.parse(document.getElementById("data").textContent);
  const live = document.getElementById("live");
  const FONT = '13px system-ui, "Segoe UI", Roboto, Arial, sans-serif';
  const SCALE = [[68, 1, 84], [59, 82, 139], [33, 145, 140], [94, 201, 98], [253, 231, 37]];
  const MISSING = 65535;

  const element = (name, parent, classes, text) => {
    const made = document.createElement(name);
    if (classes) made.className = classes;
    if (text) made.textContent = text;
    parent.appendChild(made);
    return made;
  };
  const digits = (value) => {
    if (value === null || value === undefined) return "-";
    const size = Math.abs(value);
    return size !== 0 && (size >= 1e5 || size < 1e-3) ? value.toExponential(3) : String(Number(value.toPrecision(4)));
  };

  // A panel of lines with a legend that shows the values under the pointer.
  const bandsOf = (lines, u) => {
    for (const line of lines) {
      if (!line.band) continue;
      const point = (i, side) => [u.valToPos(line.x[i], "x", true), u.valToPos(line.band[side][i], "y", true)];
      const known = line.x.map((_, i) => i).filter((i) => line.band[0][i] !== null);
      u.ctx.save();
      u.ctx.beginPath();
      u.ctx.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
      u.ctx.clip();
      u.ctx.beginPath();
      known.forEach((i) => u.ctx.lineTo(...point(i, 0)));
      known.reverse().forEach((i) => u.ctx.lineTo(...point(i, 1)));
      u.ctx.fillStyle = line.colour + "33";
      u.ctx.fill();
      u.ctx.restore();
    }
  };
  const joined = (lines) => uPlot.join(lines.map((line) => [line.x, line.y]));
  const range = (panel) => (u, low, high) => {
    if (panel.log) return uPlot.rangeLog(low || 1, high || 10, 10, false);
    const edges = panel.lines.flatMap((line) => (line.band ? line.band.flat() : [])).filter((v) => v !== null);
    const bottom = Math.min(0, low ?? 0, ...edges);
    let top = Math.max(high ?? 0, ...edges);
    if (panel.top !== null) top = Math.min(top, panel.top);
    const margin = top > bottom ? 0.06 * (top - bottom) : 1;
    return [bottom < 0 ? bottom - margin : 0, top + margin];
  };
  const plot = (parent, chart, panel, sync) => {
    const figure = element("figure", parent, "plot");
    const width = () => Math.max(260, figure.clientWidth);
    const series = panel.lines.map((line) => ({
      label: line.name || panel.label,
      stroke: line.colour,
      width: 2,
      dash: line.dashed ? [8, 5] : undefined,
      spanGaps: true,
      points: { show: line.x.length < 40 },
      value: (u, value, s, i) => {
        const at = i === null || !line.band ? -1 : line.x.indexOf(u.data[0][i]);
        const half = at < 0 || line.band[0][at] === null ? "" : " ± " + digits((line.band[1][at] - line.band[0][at]) / 2);
        return digits(value) + half;
      },
    }));
    const axis = { font: FONT, labelFont: FONT, labelSize: 22, grid: { stroke: "#e4e4e4", width: 1 } };
    const options = {
      width: width(),
      height: 230,
      cursor: { sync: { key: sync }, drag: { x: true, y: false } },
      scales: { x: { time: false, distr: chart.log ? 3 : 1 }, y: { distr: panel.log ? 3 : 1, range: range(panel) } },
      axes: [{ ...axis, label: chart.x }, { ...axis, label: panel.label, size: 64 }],
      series: [{ label: chart.x, value: (u, v) => digits(v) }, ...series],
      hooks: { drawAxes: [(u) => bandsOf(panel.lines, u)] },
    };
    const made = new uPlot(options, joined(panel.lines), figure);
    new ResizeObserver(() => {
      if (figure.clientWidth > 0 && made.width !== width()) made.setSize({ width: width(), height: 230 });
    }).observe(figure);
    return made;
  };
  const drawChart = (chart, number) => {
    element("h3", live, "", chart.title);
    const grid = element("div", live, "grid");
    for (const panel of chart.panels) plot(grid, chart, panel, "chart" + number);
  };

  // Fields: numbers of two bytes between the lowest and the highest value of a frame.
  const values = (field) => {
    const bytes = Uint8Array.from(atob(field.data), (letter) => letter.charCodeAt(0));
    const codes = new DataView(bytes.buffer);
    const step = (field.high - field.low) / (MISSING - 1);
    return Array.from({ length: bytes.length / 2 }, (_, k) => {
      const code = codes.getUint16(2 * k, true);
      return code === MISSING ? null : field.low + step * code;
    });
  };
  const colour = (share) => {
    const place = Math.min(1, Math.max(0, share)) * (SCALE.length - 1);
    const low = Math.min(SCALE.length - 2, Math.floor(place));
    return SCALE[low].map((c, k) => Math.round(c + (place - low) * (SCALE[low + 1][k] - c)));
  };
  const ticks = (low, high) => {
    const rough = (high - low) / 4, decade = 10 ** Math.floor(Math.log10(rough));
    const step = decade * [1, 2, 5, 10].find((s) => s * decade >= rough * 0.999);
    const found = [];
    for (let k = Math.ceil(low / step); k * step <= high * (1 + 1e-9); k += 1) found.push(Number((k * step).toPrecision(9)));
    return found;
  };
  const mapOf = (parent, fields, map) => {
    const figure = element("figure", parent, "plot"), canvas = element("canvas", figure, "map");
    const read = element("output", figure, "read"), small = document.createElement("canvas");
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", map.title);
    [small.width, small.height] = [fields.nx, fields.ny];
    const size = [fields.nx * fields.dx, fields.ny * fields.dy];
    let shown = [], box, pointer = null;
    const paint = () => {
      const image = small.getContext("2d").createImageData(fields.nx, fields.ny);
      shown.forEach((value, k) => {
        const at = 4 * ((fields.ny - 1 - Math.floor(k / fields.nx)) * fields.nx + (k % fields.nx));
        image.data.set(value === null ? [170, 170, 170, 255] : [...colour(value / map.high), 255], at);
      });
      small.getContext("2d").putImageData(image, 0, 0);
      const ratio = window.devicePixelRatio || 1, width = Math.max(260, figure.clientWidth);
      const inside = Math.min(width - 150, 460 * Math.max(1, size[0] / size[1] / 2)), height = Math.round(inside * Math.min(2, Math.max(0.1, size[1] / size[0])));
      box = { left: 62, top: 28, width: inside, height };
      [canvas.width, canvas.height] = [width * ratio, (height + 78) * ratio];
      canvas.style.height = height + 78 + "px";
      const c = canvas.getContext("2d");
      c.scale(ratio, ratio);
      c.font = FONT;
      c.imageSmoothingEnabled = false;
      c.drawImage(small, box.left, box.top, box.width, box.height);
      c.fillStyle = c.strokeStyle = "#111";
      c.textAlign = "center";
      c.fillText(map.title, box.left + box.width / 2, 18);
      const x = (v) => box.left + ((v - fields.x) / size[0]) * box.width, y = (v) => box.top + box.height - ((v - fields.y) / size[1]) * box.height;
      ticks(fields.x, fields.x + size[0]).forEach((v) => { c.fillRect(x(v), box.top + box.height, 1, 4); c.fillText(digits(v), x(v), box.top + box.height + 18); });
      c.fillText("x (µm)", box.left + box.width / 2, box.top + box.height + 38);
      c.textAlign = "right";
      ticks(fields.y, fields.y + size[1]).forEach((v) => { c.fillRect(box.left - 4, y(v), 4, 1); c.fillText(digits(v), box.left - 7, y(v) + 4); });
      c.fillText("y (µm)", box.left - 7, 18);
      c.strokeRect(box.left, box.top, box.width, box.height);
      const bar = box.left + box.width + 12;
      for (let k = 0; k < box.height; k += 1) {
        c.fillStyle = `rgb(${colour(1 - k / box.height)})`;
        c.fillRect(bar, box.top + k, 14, 1.5);
      }
      c.fillStyle = "#111";
      c.textAlign = "left";
      ticks(0, map.high).forEach((v) => c.fillText(digits(v), bar + 19, box.top + box.height * (1 - v / map.high) + 4));
      if (map.outline && fields.outline) {
        const [a, b, angle] = fields.outline;
        c.save();
        c.beginPath();
        c.rect(box.left, box.top, box.width, box.height);
        c.clip();
        c.strokeStyle = "#fff";
        c.beginPath();
        if (b === null) [-a, a].forEach((v) => { c.moveTo(x(v), box.top); c.lineTo(x(v), box.top + box.height); });
        else c.ellipse(x(0), y(0), (a / size[0]) * box.width, (b / size[1]) * box.height, -angle, 0, 2 * Math.PI);
        c.stroke();
        c.restore();
      }
      tell();
    };
    const tell = () => {
      const i = pointer && Math.floor(((pointer[0] - box.left) / box.width) * fields.nx);
      const j = pointer && Math.floor((1 - (pointer[1] - box.top) / box.height) * fields.ny);
      if (!pointer || i < 0 || j < 0 || i >= fields.nx || j >= fields.ny) { read.textContent = ""; return; }
      const [atX, atY] = [fields.x + (i + 0.5) * fields.dx, fields.y + (j + 0.5) * fields.dy];
      read.textContent = `x ${digits(atX)} µm, y ${digits(atY)} µm: ${digits(shown[j * fields.nx + i])} ${map.unit}`;
    };
    canvas.addEventListener("pointermove", (event) => { pointer = [event.offsetX, event.offsetY]; tell(); });
    canvas.addEventListener("pointerleave", () => { pointer = null; tell(); });
    new ResizeObserver(() => { if (figure.clientWidth > 0 && shown.length > 0) paint(); }).observe(figure);
    return (field) => { shown = values(field); paint(); };
  };
  const lineOf = (parent, fields, map) => {
    const x = Array.from({ length: fields.nx }, (_, k) => fields.x + (k + 0.5) * fields.dx);
    const line = { name: map.title, colour: "#0072b2", x, y: x.map(() => null), band: null };
    const made = plot(parent, { x: "x (µm)", log: false }, { label: map.unit, top: map.high, log: false, lines: [line] }, "fields");
    return (field) => made.setData([x, values(field)]);
  };
  const drawFields = (fields) => {
    element("h3", live, "", fields.title);
    const slider = element("div", live, "slider"), grid = element("div", live, fields.ny > 1 ? "grid maps" : "grid");
    const show = fields.maps.map((map) => (fields.ny > 1 ? mapOf : lineOf)(grid, fields, map));
    const update = (k) => show.forEach((one, m) => one(fields.frames[k].fields[m]));
    if (fields.frames.length > 1) {
      const label = element("label", slider, "", "Contact at"), input = element("input", label.parentNode), at = element("output", slider);
      input.type = "range";
      [input.min, input.max, input.value] = [0, fields.frames.length - 1, fields.frames.length - 1];
      label.htmlFor = input.id = "frame";
      input.addEventListener("input", () => { update(Number(input.value)); at.textContent = fields.frames[Number(input.value)].label; });
      at.textContent = fields.frames[fields.frames.length - 1].label;
    }
    update(fields.frames.length - 1);
  };

  data.charts.forEach(drawChart);
  if (data.fields) drawFields(data.fields);
})();
