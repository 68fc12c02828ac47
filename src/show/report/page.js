// Draws the run that stands in #data. `#view=3` in the address opens at the third view.
'use strict';
const run = JSON.parse(document.getElementById('data').textContent);
const { head, end, space, candidates, surface, frames } = run;
const at = (id) => document.getElementById(id);
const names = (map) => Object.keys(map);
const colours = ['#d1495b', '#0b6bcb', '#2e933c', '#b8860b', '#7d4fb3', '#008b8b', '#c2571a', '#5b6670'];
const features = names(head.weights);
const colourOf = (feature) => colours[features.indexOf(feature) % colours.length];
const percent = (share) => (100 * share).toFixed(1) + ' %';
const quiet = { displayModeBar: false, responsive: true };
const ground = { paper_bgcolor: '#fff', plot_bgcolor: '#fff', font: { family: 'system-ui, sans-serif', size: 12 }, margin: { l: 45, r: 10, t: 10, b: 40 } };

function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

// The middle of voxels, metres, as columns.
function centres(cells) {
  const axis = (k) => cells.map((cell) => +(space.origin[k] + (cell[k] + 0.5) * space.voxel).toFixed(4));
  return { x: axis(0), y: axis(1), z: axis(2) };
}

function lines(outlines) {
  const columns = { x: [], y: [], z: [] };
  for (const outline of outlines) {
    for (const [x, y, z] of [...outline, [null, null, null]]) {
      columns.x.push(x); columns.y.push(y); columns.z.push(z);
    }
  }
  return columns;
}

function surfaceAt(now) {
  const shown = [];
  for (let k = 0; k < surface.x.length; k++) {
    if (surface.from[k] <= now && (surface.to[k] === null || surface.to[k] > now)) shown.push(k);
  }
  const places = centres(shown.map((k) => [surface.x[k], surface.y[k], surface.z[k]]));
  const rgb = (c) => `rgb(${c >> 16},${(c >> 8) & 255},${c & 255})`;
  return { ...places, type: 'scatter3d', mode: 'markers', name: 'surface', hoverinfo: 'skip',
    marker: { size: 3, symbol: 'square', color: shown.map((k) => rgb(surface.colour[k])), line: { width: 0 } } };
}

function places(frame) {
  const drawn = [];
  for (const feature of new Set(frame.predicted.map((p) => p.feature))) {
    const own = frame.predicted.filter((p) => p.feature === feature);
    const common = { type: 'scatter3d', legendgroup: feature, hoverinfo: 'name' };
    drawn.push({ ...common, ...centres(own.flatMap((p) => p.open)), mode: 'markers', name: `${feature} predicted`,
      marker: { size: 2.5, symbol: 'square', color: colourOf(feature), opacity: 0.55 } });
    drawn.push({ ...common, ...lines(own.flatMap((p) => p.outlines)), mode: 'lines', name: `${feature} predicted`, showlegend: false,
      line: { color: colourOf(feature), width: 2, dash: 'dash' } });
  }
  for (const feature of new Set(frame.found.map((f) => f.feature))) {
    const own = frame.found.filter((f) => f.feature === feature);
    drawn.push({ type: 'scatter3d', legendgroup: feature, ...lines(own.flatMap((f) => f.outlines)), mode: 'lines',
      name: `${feature} measured`, hoverinfo: 'name', line: { color: colourOf(feature), width: 6 } });
  }
  return drawn;
}

function views(now) {
  const gains = new Map(frames[now].gains);
  const open = candidates.map((_, k) => k).filter((k) => gains.has(k));
  const point = (k) => candidates[k];
  const columns = (ks) => ({ x: ks.map((k) => point(k)[0]), y: ks.map((k) => point(k)[1]), z: ks.map((k) => point(k)[2]) });
  const idle = open.filter((k) => gains.get(k) <= 0), useful = open.filter((k) => gains.get(k) > 0);
  const hover = (k) => `view ${k}<br>gain ${+gains.get(k).toPrecision(4)}`;
  const path = frames.slice(0, now + 1).map((f) => f.view.view);
  const drawn = [
    { ...columns(idle), type: 'scatter3d', mode: 'markers', name: 'views without gain', text: idle.map((k) => `view ${k}`), hoverinfo: 'text',
      marker: { size: 3, color: '#c3cad1' } },
    { ...columns(useful), type: 'scatter3d', mode: 'markers', name: 'views with gain', text: useful.map(hover), hoverinfo: 'text',
      marker: { size: 6, color: useful.map((k) => gains.get(k)), colorscale: 'Viridis', reversescale: true, cmin: 0, showscale: useful.length > 0,
        colorbar: { title: { text: 'gain' }, thickness: 10, len: 0.5, x: 0 } } },
    { ...columns(path), type: 'scatter3d', mode: 'lines+markers+text', name: 'path', text: path.map((_, k) => String(k + 1)), textposition: 'top center',
      hoverinfo: 'text', marker: { size: 6, color: '#111' }, line: { color: '#111', width: 4 } },
  ];
  const next = frames[now].view.next;
  if (next) {
    drawn.push({ ...columns([path[path.length - 1], next.view]), type: 'scatter3d', mode: 'lines', name: 'next', hoverinfo: 'skip',
      line: { color: '#111', width: 3, dash: 'dot' } });
  }
  return drawn;
}

const sceneLayout = { ...ground, margin: { l: 0, r: 0, t: 0, b: 0 }, uirevision: 'kept', autosize: true, legend: { orientation: 'h', y: 0, itemsizing: 'constant' },
  scene: { aspectmode: 'data', uirevision: 'kept', xaxis: { title: { text: 'x, m' } }, yaxis: { title: { text: 'y, m' } }, zaxis: { title: { text: 'z, m' } } } };

function drawScene(now) {
  return Plotly.react('scene', [surfaceAt(now), ...places(frames[now]), ...views(now)], sceneLayout, { responsive: true, displaylogo: false });
}

function drawPicture(frame) {
  const box = at('picture');
  box.replaceChildren();
  const picture = frame.picture;
  if (!picture) {
    box.append('No picture.');
    return;
  }
  box.append(element('img', { src: picture.source, alt: `colour image of view ${frame.view.view}` }));
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', `0 0 ${picture.width} ${picture.height}`);
  const labelled = new Set();
  const newFirst = [...picture.marks].sort((a, b) => b.new - a.new);
  for (const mark of newFirst) {
    const kind = mark.new ? 'new' : 'known';
    const shape = document.createElementNS(svg.namespaceURI, 'polygon');
    shape.setAttribute('points', mark.outline.map((p) => p.join(',')).join(' '));
    shape.setAttribute('class', kind);
    shape.style.stroke = colourOf(mark.feature);
    const label = document.createElementNS(svg.namespaceURI, 'text');
    const middle = (k) => mark.outline.reduce((sum, p) => sum + p[k], 0) / mark.outline.length;
    label.setAttribute('x', middle(0));
    label.setAttribute('y', middle(1));
    label.setAttribute('text-anchor', 'middle');
    label.setAttribute('class', kind);
    label.style.fontSize = `${picture.width / 38}px`;
    label.textContent = mark.feature;
    svg.append(shape);
    if (!labelled.has(mark.feature)) svg.append(label);
    labelled.add(mark.feature);
  }
  box.append(svg);
}

function table(header, rows) {
  const row = (cells, tag) => element('tr', {}, ...cells.map((cell) => (cell instanceof Node ? cell : element(tag, {}, String(cell)))));
  return element('table', {}, element('thead', {}, row(header, 'th')), element('tbody', {}, ...rows.map((cells) => row(cells, 'td'))));
}

function drawDecision(frame) {
  const box = at('decision'), { next, stop } = frame.view;
  if (!next) {
    box.replaceChildren(element('p', {}, frame.line.slice(frame.line.indexOf('stop'))));
    if (stop) {
      const number = (c) => (c.found === undefined || c.found === null ? '' : Array.isArray(c.found) ? c.found.join(', ') : c.found);
      box.append(table(['condition', 'found', 'holds'], stop.because.map((c) => [c.of ? `${c.name} of ${c.of}` : c.name, number(c), c.holds ? '✓' : '✗'])));
    }
    return;
  }
  const standing = (s) => [`#${s.view}`, +s.score.toPrecision(4), +s.terms.feature.toFixed(3), s.terms.surface, s.terms.w, s.terms.overlap,
    s.share === undefined ? '' : percent(s.share), s.distance === undefined ? '' : s.distance.toFixed(2),
    s.target ? `${s.target.feature}: ${s.target.reached} of ${s.target.voxels} voxels` : ''];
  const header = ['view', 'score', 'feature, bits', 'surface, voxels', 'W', 'overlap', 'share', 'way, m', 'for'];
  box.replaceChildren(table(header, [next, ...next.runners_up].map(standing)));
  box.querySelector('tbody tr').className = 'chosen';
  if (next.relaxed) box.append(element('p', { className: 'hint' }, 'No view with gain met the overlap constraint; the one of largest overlap was taken.'));
}

function drawFeatures(now) {
  const header = ['feature', ...frames.map((f) => f.view.n), 'instances', 'weight, bits', 'inspected'];
  const rows = features.map((name) => {
    const states = frames.map((f, k) => {
      const { state, predicted } = f.view.features[name];
      const cell = element('td', { className: `s${state}${k === now ? ' now' : ''}` }, String(state).replace('-', '−') + (predicted ? '·' : ''));
      return cell;
    });
    const { instances, weight } = frames[now].view.features[name];
    const measured = instances.filter((i) => i.predicted_voxels === 0).length;
    const places = instances.filter((i) => i.predicted_voxels > 0).map((i) => percent(i.inspected));
    return [name, ...states, `${measured} of ${instances.length}`, weight.toFixed(3), places.join(', ')];
  });
  at('features').replaceChildren(table(header, rows));
}

const mark = (now) => ({ shapes: [{ type: 'line', x0: now + 1, x1: now + 1, yref: 'paper', y0: 0, y1: 1, line: { color: '#0b6bcb', width: 1.5, dash: 'dot' } }] });
const overViews = { title: { text: 'view' }, dtick: frames.length > 12 ? 2 : 1, range: [0.7, frames.length + 0.3] };
const n = frames.map((f) => f.view.n);

function drawCurves(now) {
  const possible = names(frames[0].view.classes).filter((name) => frames.some((f) => f.view.classes[name] > 0));
  const posterior = possible.map((name) => ({ x: n, y: frames.map((f) => f.view.classes[name]), name, type: 'bar' }));
  Plotly.react('classes', posterior, { ...ground, ...mark(now), barmode: 'stack', xaxis: overViews, yaxis: { title: { text: 'probability' }, range: [0, 1.02] } }, quiet);
  const states = ['unknown', 'free', 'occupied', 'preoccupied'];
  const voxels = states.map((state) => ({ x: n, y: frames.map((f) => f.view.voxels[state]), name: state, mode: 'lines+markers' }));
  Plotly.react('voxels', voxels, { ...ground, ...mark(now), xaxis: overViews, yaxis: { title: { text: 'voxels' }, type: 'log' } }, quiet);
  const stages = ['sense', 'detect', 'map', 'score'];
  const times = stages.map((stage) => ({ x: n, y: frames.map((f) => f.view.ms[stage]), name: stage, type: 'bar' }));
  Plotly.react('times', times, { ...ground, ...mark(now), barmode: 'stack', xaxis: overViews, yaxis: { title: { text: 'ms' } } }, quiet);
}

function drawHead() {
  const task = `${head.task}: ${head.object}`;
  document.title = `vpl run: ${task}`;
  at('title').textContent = task;
  const outcome = end ? [`outcome ${end.outcome}`, `${end.views} views`, end.class ? `class ${end.class} (p = ${end.confidence.toFixed(3)})` : '',
    end.coverage === null ? '' : `coverage ${percent(end.coverage)}`, end.contradiction ? `${end.contradiction.feature}: ${end.contradiction.evidence}` : ''] : ['the run was cut off'];
  const thinned = surface.every > 1 ? `one surface voxel in ${surface.every} is drawn` : '';
  at('summary').textContent = [...outcome, `method ${head.method}`, `noise ${head.noise}`, `seed ${head.seed}`, head.file, `vpl ${head.vpl}`, thinned].filter(Boolean).join(' · ');
}

function show(view) {
  const now = Math.min(Math.max(view, 1), frames.length) - 1;
  at('slider').value = now + 1;
  at('line').textContent = frames[now].line.trim().replace(/ {2,}/g, '   ');
  drawPicture(frames[now]);
  drawDecision(frames[now]);
  drawFeatures(now);
  drawCurves(now);
  drawScene(now).then(() => {
    document.body.dataset.shown = now + 1;
    document.body.dataset.traces = at('scene').data.length;
    document.body.dataset.surface = at('scene').data[0].x.length;
  });
}

window.addEventListener('error', (event) => { document.body.dataset.error = event.message; });
document.addEventListener('securitypolicyviolation', (event) => { document.body.dataset.error = `refused: ${event.blockedURI}`; });
drawHead();
if (frames.length > 0) {
  at('slider').max = frames.length;
  at('slider').addEventListener('input', () => show(+at('slider').value));
  at('back').addEventListener('click', () => show(+at('slider').value - 1));
  at('forth').addEventListener('click', () => show(+at('slider').value + 1));
  const asked = /view=(\d+)/.exec(location.hash);
  window.addEventListener('hashchange', () => show(+(/view=(\d+)/.exec(location.hash) || [0, frames.length])[1]));
  show(asked ? +asked[1] : frames.length);
}
