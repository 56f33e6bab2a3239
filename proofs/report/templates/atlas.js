"use strict";
(() => {
  const read = (id) => JSON.parse(document.getElementById(id).textContent);
  const {patterns, said, roots, names} = read("cells");
  const ends = read("ends");
  const map = document.getElementById("map");
  const svg = map.querySelector("svg");
  const here = document.getElementById("here");
  const panel = document.getElementById("cell");
  const form = document.querySelector(".look");
  const side = svg.viewBox.baseVal.width;
  const SPLIT = -1, NOTHING = -2, SIDES = {[-1]: "eta", [-2]: "nu"};

  // places on the map are shares of the region's sides, from the lower left corner
  const grown = (root) => {
    let next = 0;
    const node = (depth, x, y) => {
      const code = root.tree[next++];
      if (code !== SPLIT) return {root, depth, x, y, code};
      const quarters = [0, 1, 2, 3].map((k) => node(depth + 1, 2 * x + (k & 1), 2 * y + (k >> 1)));
      return {quarters};
    };
    return node(0, 0, 0);
  };
  const trees = roots.map((root) => ({on: root.map, top: grown(root)}));

  const find = (x, y) => {
    for (const {on: [left, right, bottom, top], top: whole} of trees) {
      if (!(x >= left && x <= right && y >= bottom && y <= top)) continue;
      let [u, v, cell] = [(x - left) / (right - left), (y - bottom) / (top - bottom), whole];
      while (cell.quarters) {
        const [a, b] = [u >= 0.5 ? 1 : 0, v >= 0.5 ? 1 : 0];
        [u, v, cell] = [2 * u - a, 2 * v - b, cell.quarters[a + 2 * b]];
      }
      return cell;
    }
    return null;
  };
  const bounds = ({root: {map: [left, right, bottom, top]}, depth, x, y}) => {
    const [width, height] = [(right - left) / 2 ** depth, (top - bottom) / 2 ** depth];
    return {left: left + x * width, right: left + (x + 1) * width,
      bottom: bottom + y * height, top: bottom + (y + 1) * height};
  };
  const number = (name, share) => ends[name][0] + share * (ends[name][1] - ends[name][0]);
  const box = (cell) => {
    const {root, depth} = cell, unit = 2 ** (root.depth - depth), about = bounds(cell);
    const text = (name, k, share) => root[name][k * unit] ?? String(Number(number(name, share).toPrecision(9)));
    return {eta: `[${text("eta", cell.x, about.left)}, ${text("eta", cell.x + 1, about.right)}]`,
      nu: `[${text("nu", cell.y, about.bottom)}, ${text("nu", cell.y + 1, about.top)}]`};
  };
  const sentence = (cell) => {
    if (cell.code === NOTHING) return {verdict: "", text: "This part is not looked at yet."};
    const [pattern, ...numbers] = said[cell.code].split(" ");
    const [verdict, , parts] = patterns[pattern], sides = box(cell);
    const text = parts.map((part) => typeof part === "string" ? part
      : part < 0 ? sides[SIDES[part]] : numbers[part]).join("");
    return {verdict, text};
  };

  // less than any cell of a map that is seen, and more than the strip at nu = 0
  const least = Math.max(2e-6, Math.min(...roots.map(({map: [left, right, bottom, top], depth}) =>
    Math.min(right - left, top - bottom) / 2 ** (depth + 1))));

  let shown = null, kept = false, place = {x: 0.5, y: 0.5}, view = {x: 0, y: 0, size: 1};

  const element = (name, text, kind) => {
    const made = document.createElement(name);
    made.textContent = text;
    if (kind) made.className = kind;
    return made;
  };
  const show = (cell) => {
    if (!cell || cell === shown) return;
    shown = cell;
    const {verdict, text} = sentence(cell), {eta, nu} = box(cell), at = bounds(cell);
    const why = verdict === "UNDECIDED" ? `Neither proved nor refuted: ${text}.` : text;
    const word = verdict ? verdict[0] + verdict.slice(1).toLowerCase() : "Not looked at";
    panel.className = `cell ${verdict}`;
    panel.replaceChildren(element("h2", "This cell"), element("span", word, `chip ${verdict}`),
      element("p", `${names[0]} in ${eta}\n${names[1]} in ${nu}`, "box"), element("p", why, "says"));
    for (const [name, value] of Object.entries({x: at.left, y: 1 - at.top,
      width: at.right - at.left, height: at.top - at.bottom})) here.setAttribute(name, value * side);
    here.removeAttribute("hidden");
  };
  const keep = (yes) => {
    kept = yes;
    map.classList.toggle("kept", yes);
    const {x, y} = place;
    const hash = yes ? `#${number("eta", x).toPrecision(9)},${number("nu", y).toPrecision(9)}` : " ";
    history.replaceState(null, "", hash === " " ? location.pathname : hash);
  };

  const ticks = (name, low, high) => {
    const width = high - low, power = 10 ** Math.floor(Math.log10(width / 4));
    const step = [5, 2, 1].map((k) => k * power).find((k) => width / k >= 3) ?? power;
    const places = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
    const list = document.querySelector(`.ticks.${name}`);
    list.replaceChildren();
    for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; k++) {
      const tick = element("li", (k * step).toFixed(places).replace("-", "−"));
      const share = 100 * (k * step - low) / width;
      tick.style[name === "eta" ? "left" : "bottom"] = `${share}%`;
      if (name === "nu") tick.style.transform = "translateY(50%)";
      list.append(tick);
    }
  };
  const draw = () => {
    view.x = Math.min(Math.max(view.x, 0), 1 - view.size);
    view.y = Math.min(Math.max(view.y, 0), 1 - view.size);
    const {x, y, size} = view;
    svg.setAttribute("viewBox", [x, 1 - y - size, size, size].map((k) => k * side).join(" "));
    for (const label of map.querySelectorAll(".name")) {
      label.style.left = `${100 * (label.dataset.x / side - x) / size}%`;
      label.style.top = `${100 * (label.dataset.y / side - (1 - y - size)) / size}%`;
    }
    ticks("eta", number("eta", x), number("eta", x + size));
    ticks("nu", number("nu", y), number("nu", y + size));
  };
  const zoom = (factor) => {
    const size = Math.min(1, Math.max(1e-6, view.size / factor));
    view = {x: place.x - size / 2, y: place.y - size / 2, size};
    draw();
  };
  const go = (x, y) => {
    const cell = find(x, y);
    if (!cell) return false;
    place = {x, y};
    const {x: left, y: low, size} = view;
    if (x < left || x > left + size || y < low || y > low + size) zoom(1);
    show(cell);
    return true;
  };
  const step = (dx, dy) => {
    const at = bounds(find(place.x, place.y));
    const x = dx > 0 ? at.right + least : dx < 0 ? at.left - least : place.x;
    const y = dy > 0 ? at.top + least : dy < 0 ? at.bottom - least : place.y;
    const next = find(x, y);
    if (!next) return;
    const {left: a, right: b, bottom: c, top: d} = bounds(next);
    go(dx ? (a + b) / 2 : x, dy ? (c + d) / 2 : y);
  };

  const pointed = (event) => {
    const {left, top, width, height} = svg.getBoundingClientRect();
    return [view.x + view.size * (event.clientX - left) / width,
      view.y + view.size * (1 - (event.clientY - top) / height)];
  };
  map.addEventListener("pointermove", (event) => {
    if (!kept) go(...pointed(event));
  });
  map.addEventListener("click", (event) => {
    const cell = find(...pointed(event)), again = kept && cell === shown;
    if (go(...pointed(event))) keep(!again);
  });
  map.addEventListener("focus", () => {
    if (!shown) go(place.x, place.y);
  });
  const keys = {ArrowRight: () => step(1, 0), ArrowLeft: () => step(-1, 0), ArrowUp: () => step(0, 1),
    ArrowDown: () => step(0, -1), Enter: () => keep(true), " ": () => keep(true),
    Escape: () => keep(false), "+": () => zoom(2), "=": () => zoom(2), "-": () => zoom(0.5), "0": () => zoom(0)};
  map.addEventListener("keydown", (event) => {
    if (!keys[event.key] || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    keys[event.key]();
  });
  form.nearer.addEventListener("click", () => zoom(2));
  form.farther.addEventListener("click", () => zoom(0.5));
  form.whole.addEventListener("click", () => zoom(0));
  const look = (eta, nu) => {
    const share = (name, value) => (value - ends[name][0]) / (ends[name][1] - ends[name][0]);
    if (String(eta).trim() && String(nu).trim() && go(share("eta", Number(eta)), share("nu", Number(nu)))) {
      keep(true);
      return true;
    }
    return false;
  };
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    if (look(form.eta.value, form.nu.value)) return;
    shown = null;
    panel.replaceChildren(element("h2", "A cell"), element("p",
      `No cell is at these numbers; ${names[0]} is from ${ends.eta.join(" to ")}, ${names[1]} from ${ends.nu.join(" to ")}.`, "bad"));
  });
  const follow = () => {
    const numbers = location.hash.slice(1).split(",");
    if (numbers.length === 2) look(...numbers);
  };
  addEventListener("hashchange", follow);
  form.hidden = false;
  draw();
  follow();
})();
