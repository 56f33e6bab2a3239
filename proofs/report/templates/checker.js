"use strict";
// Runs the checker, in CPython compiled to WebAssembly, in a worker; nothing leaves this page.
(() => {
  const part = (name) => document.getElementById(`checker-${name}`).textContent;
  const bytes = async (name) => {
    const packed = Uint8Array.from(atob(part(name)), (c) => c.charCodeAt(0));
    const stream = new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  };
  const box = document.getElementById("checker");
  const button = box.querySelector("button");
  const told = box.querySelector("output");
  const list = box.querySelector("ol");

  const worker = async () => {
    const source = new Blob([await bytes("worker.js")], {type: "text/javascript"});
    return new Worker(URL.createObjectURL(source));
  };

  const compare = ({claims = {}, rejected, name, seconds}) => {
    const item = document.createElement("li");
    let same = 0;
    let all = 0;
    for (const [id, verdict] of Object.entries(claims)) {
      const claim = document.getElementById(id);
      if (!claim || claim.dataset.file !== `${name}.json`) continue;
      const agrees = claim.dataset.verdict === verdict;
      claim.dataset.derived = agrees ? "same" : "other";
      same += agrees;
      all += 1;
      if (!agrees) item.className = "bad";
    }
    if (rejected) item.className = "bad";
    item.textContent = rejected ? `${name}: rejected, ${rejected}`
      : `${name}: ${same} of ${all}, in ${seconds.toFixed(1)} s`;
    list.append(item);
    return same;
  };

  button.addEventListener("click", async () => {
    button.disabled = true;
    list.replaceChildren();
    for (const claim of document.querySelectorAll(".claim")) delete claim.dataset.derived;
    told.value = "Python is being unpacked …";
    const began = performance.now();
    const running = await worker();
    let same = 0;
    const end = (text) => {
      told.value = text;
      button.disabled = false;
      running.terminate();
    };
    running.onerror = (event) => end(`The worker failed: ${event.message}`);
    running.onmessage = ({data}) => {
      if (data.ready) told.value = `CPython ${data.ready} derives the verdicts …`;
      else if (data.failed) end(`The checker failed: ${data.failed}`);
      else if (data.done) {
        const all = document.querySelectorAll(".claim").length;
        const bad = list.querySelector(".bad") || same < all ? "NOT ALL AS PRINTED: " : "";
        end(`${bad}${same} of ${all} verdicts derived here, in ${((performance.now() - began) / 1000).toFixed(0)} s.`);
      } else same += compare(data);
    };
    const files = {};
    for (const name of ["pyodide.asm.wasm", "python_stdlib.zip", "trusted.zip"]) files[name] = await bytes(name);
    const text = async (name) => new TextDecoder().decode(await bytes(name));
    running.postMessage({files, lock: JSON.parse(part("lock")), code: part("code"),
      certificates: JSON.parse(await text("certificates"))});
  });
})();
