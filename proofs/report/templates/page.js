"use strict";
(() => {
  const form = document.querySelector(".toolbar");
  const claims = [...document.querySelectorAll(".claim")];
  const chapters = [...document.querySelectorAll(".chapter")];
  const nothing = document.querySelector(".nothing");
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
    for (const chapter of chapters) chapter.hidden = !chapter.querySelector(".claim:not([hidden])");
    nothing.hidden = shown > 0;
    const own = (list) => list.filter((claim) => "own" in claim.dataset).length;
    const seen = claims.filter((claim) => !claim.hidden);
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
    for (const each of document.querySelectorAll("details")) each.open = true;
  });
  filter();
  follow();
})();
