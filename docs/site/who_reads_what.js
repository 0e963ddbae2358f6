// The matrix of features: a filter above it, and colors for its verdicts. The page is whole without this script.
(() => {
  const matrix = document.getElementById("matrix");
  if (!matrix) return;
  const VERDICTS = ["reads", "warns", "differs", "refuses"];
  const tables = [...matrix.querySelectorAll("table")];
  const consumers = [...tables[0].rows[0].cells].slice(2).map(cell => cell.textContent.trim());
  for (const table of tables)
    for (const row of table.tBodies[0].rows)
      [...row.cells].slice(2).forEach(cell => VERDICTS.includes(cell.textContent) && (cell.className = cell.textContent));

  const make = (tag, properties, ...inside) => {
    const made = Object.assign(document.createElement(tag), properties);
    made.append(...inside);
    return made;
  };
  const choice = (label, first, values) => {
    const select = make("select", {}, ...[first, ...values].map((text, n) => make("option", { value: n ? text : "" }, text)));
    return [select, make("label", {}, `${label} `, select)];
  };
  const words = make("input", { type: "search" });
  const [format, ofFormat] = choice("Format", "both", ["URDF", "SDF"]);
  const [verdict, ofVerdict] = choice("Some program", "does anything", VERDICTS);
  const boxes = consumers.map(name => make("input", { type: "checkbox", checked: true, value: name }));
  const programs = make("details", {}, make("summary", {}, "Programs"),
    make("button", { type: "button", onclick: () => all(true) }, "All"), " ",
    make("button", { type: "button", onclick: () => all(false) }, "None"),
    ...boxes.map(box => make("label", {}, box, ` ${box.value}`)));
  const count = make("p", { role: "status" });
  const bar = make("form", { id: "matrix-filter", onsubmit: () => false },
    make("label", {}, "Words ", words), ofFormat, ofVerdict, programs, count);
  matrix.prepend(bar);

  const all = checked => { boxes.forEach(box => (box.checked = checked)); filter(); };
  function filter() {
    const shown = boxes.map(box => box.checked);
    const wanted = words.value.toLowerCase().split(/\s+/).filter(Boolean);
    let left = 0, every = 0;
    for (const table of tables) {
      let some = false;
      for (const row of table.rows) {
        [...row.cells].slice(2).forEach((cell, n) => (cell.hidden = !shown[n]));
        if (row.parentNode === table.tHead) continue;
        const about = row.cells[0].textContent.toLowerCase() + " " + row.cells[0].querySelector("a").getAttribute("href");
        const seen = [...row.cells].slice(2).filter((cell, n) => shown[n]).map(cell => cell.textContent);
        row.hidden = !(wanted.every(word => about.includes(word))
          && (!format.value || row.cells[1].textContent === format.value)
          && (!verdict.value || seen.includes(verdict.value)));
        every += 1;
        if (!row.hidden) { some = true; left += 1; }
      }
      const section = table.closest(".matrix-part");
      section.hidden = !some;
    }
    count.textContent = `${left} of ${every} features`;
    keep();
  }
  // the choice stands in the address, so that it can be passed on
  function keep() {
    const kept = new URLSearchParams();
    if (words.value) kept.set("words", words.value);
    if (format.value) kept.set("format", format.value);
    if (verdict.value) kept.set("verdict", verdict.value);
    const chosen = boxes.filter(box => box.checked).map(box => box.value);
    if (chosen.length < boxes.length) kept.set("programs", chosen.join(","));
    const query = kept.toString();
    history.replaceState(null, "", `${location.pathname}${query ? `?${query}` : ""}${location.hash}`);
  }
  const asked = new URLSearchParams(location.search);
  words.value = asked.get("words") || "";
  format.value = asked.get("format") || "";
  verdict.value = asked.get("verdict") || "";
  if (asked.has("programs")) {
    const chosen = asked.get("programs").split(",");
    boxes.forEach(box => (box.checked = chosen.some(name => name && box.value.toLowerCase().startsWith(name.toLowerCase()))));
  }
  bar.addEventListener("input", filter);
  filter();
})();
