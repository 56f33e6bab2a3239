"use strict";
(() => {
  const form = document.querySelector(".toolbar");
  const claims = [...document.querySelectorAll(".claim")];
  const chapters = [...document.querySelectorAll(".chapter")];
  const nothing = document.querySelector(".nothing");
  const results = document.querySelector(".results");
  const homes = claims.map((claim) => claim.parentElement);
  const names = {α: "alpha", β: "beta", γ: "gamma", δ: "delta", ε: "epsilon", η: "eta", θ: "theta",
    λ: "lambda", μ: "mu", ν: "nu", π: "pi", ρ: "rho", σ: "sigma", τ: "tau", φ: "phi", ψ: "psi",
    ω: "omega", Λ: "lambda", Δ: "delta", "≤": "<=", "≥": ">=", "−": "-", "′": "'"};
  const spelt = (text) => text.toLowerCase().replace(/[^\x00-\x7f]/g, (c) => names[c] ?? c);
  const index = new Map();
  const ids = new Set(claims.map((claim) => claim.id.toLowerCase()));
  const textOf = (claim) => {
    if (!index.has(claim)) {
      const marked = claim.innerHTML.replaceAll("<sub>", "_").replaceAll("<sup>", "^");
      const text = spelt(marked.replace(/<[^>]*>/g, "").replaceAll("&lt;", "<").replaceAll("&gt;", ">"));
      index.set(claim, `${text} ${text.replaceAll("_", "")}`);
    }
    return index.get(claim);
  };

  // where a word stands in the claim itself, and then how often in all that is said of it
  const score = (claim, words) => {
    const head = spelt(claim.firstElementChild.textContent);
    const count = (text, word) => text.split(word).length - 1;
    return words.reduce((sum, word) =>
      sum + 10 * count(head, word) + Math.min(20, count(textOf(claim), word)), 0);
  };

  const arrange = (words, seen) => {
    results.hidden = !words.length;
    if (!words.length) return claims.forEach((claim, k) => homes[k].append(claim));
    const scores = new Map(seen.map((claim) => [claim, score(claim, words)]));
    results.append(...seen.sort((a, b) => scores.get(b) - scores.get(a)));
  };

  const highlight = (words, seen) => {
    if (!CSS.highlights) return;
    CSS.highlights.delete("found");
    const ranges = [];
    for (const word of words.filter((each) => each.length > 1)) {
      for (const claim of seen) {
        const nodes = document.createTreeWalker(claim, NodeFilter.SHOW_TEXT);
        while (nodes.nextNode() && ranges.length < 5000) {
          const text = nodes.currentNode.data.toLowerCase();
          for (let at = text.indexOf(word); at >= 0; at = text.indexOf(word, at + 1)) {
            const range = new Range();
            range.setStart(nodes.currentNode, at);
            range.setEnd(nodes.currentNode, at + word.length);
            ranges.push(range);
          }
        }
      }
    }
    if (ranges.length) CSS.highlights.set("found", new Highlight(...ranges));
  };

  const filter = () => {
    const words = spelt(form.query.value).split(/\s+/).filter(Boolean);
    const verdicts = new Set([...form.querySelectorAll("[name=verdict]:checked")].map((x) => x.value));
    let shown = 0;
    for (const claim of claims) {
      const id = claim.id.toLowerCase();
      const {verdict, section} = claim.dataset;
      const fits = (!verdicts.has(verdict) && form.querySelector(`[value=${verdict}]`)) ? false
        : (!form.section.value || section === form.section.value)
        && words.every((word) => ids.has(word) ? id === word : textOf(claim).includes(word));
      claim.hidden = !fits;
      shown += fits;
    }
    for (const figures of document.querySelectorAll(".figures")) figures.hidden = shown < claims.length;
    const seen = claims.filter((claim) => !claim.hidden);
    arrange(words, [...seen]);
    highlight(words, seen);
    for (const chapter of chapters) chapter.hidden = !chapter.querySelector(".claim:not([hidden])");
    nothing.hidden = shown > 0;
    const own = (list) => list.filter((claim) => "own" in claim.dataset).length;
    const paper = claims.length - own(claims);
    const counted = shown === claims.length ? `${paper}` : `${seen.length - own(seen)} of ${paper}`;
    form.shown.value = `${counted} claims of the paper` + (own(seen) ? `, ${own(seen)} of our own` : "");
  };

  const reset = () => {
    form.reset();
    filter();
  };

  const follow = () => {
    const name = decodeURIComponent(location.hash.slice(1));
    const target = document.getElementById(name) ?? document.getElementById(name.toUpperCase());
    if (!target) return;
    for (let at = target; at; at = at.parentElement) if (at.tagName === "DETAILS") at.open = true;
    if (target.closest("[hidden]")) reset();
    target.scrollIntoView();
  };

  form.hidden = false;
  form.addEventListener("input", filter);
  form.addEventListener("submit", (event) => event.preventDefault());
  form.open.addEventListener("click", () => {
    const open = form.open.textContent === "Open all";
    for (const claim of claims) if (!claim.hidden) claim.open = open;
    form.open.textContent = open ? "Close all" : "Open all";
  });
  document.querySelector(".reset").addEventListener("click", reset);
  for (const link of document.querySelectorAll("[data-only]")) {
    link.addEventListener("click", () => {
      reset();
      for (const box of form.querySelectorAll("[name=verdict]")) box.checked = box.value === link.dataset.only;
      filter();
    });
  }
  document.addEventListener("click", (event) => {
    const link = event.target.closest("a[href^='#']");
    if (link && link.getAttribute("href") === location.hash) follow();
  });
  addEventListener("hashchange", follow);
  addEventListener("beforeprint", () => {
    for (const each of document.querySelectorAll("details:not(.more)")) each.open = true;
    for (const math of document.querySelectorAll(".line math")) {
      math.style.fontSize = `${Math.min(0.85, 600 / math.getBoundingClientRect().width)}em`;
    }
  });
  addEventListener("afterprint", () => {
    for (const math of document.querySelectorAll(".line math")) math.style.fontSize = "";
  });
  filter();
  follow();
})();
