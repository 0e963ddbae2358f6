// Sorts tables by a column when its heading is pressed: numbers by their values, names as people sort them.
for (const table of document.querySelectorAll("table.sortable")) {
  const heads = [...table.tHead.rows[0].cells];
  const body = table.tBodies[0];
  const key = (row, index) => {
    const cell = row.cells[index];
    return cell.dataset.value === undefined ? cell.textContent : Number(cell.dataset.value);
  };
  const order = (a, b) => {
    if (a === "" || b === "") return (a === "") - (b === "");
    if (typeof a === "number" && typeof b === "number") return a - b;
    return String(a).localeCompare(String(b), undefined, { numeric: true });
  };
  heads.forEach((head, index) => {
    head.querySelector("button").addEventListener("click", () => {
      const down = head.getAttribute("aria-sort") === "descending";
      const isNumber = index > 0;
      const ascending = head.hasAttribute("aria-sort") ? down : !isNumber;
      const rows = [...body.rows].map((row) => [key(row, index), row]);
      const empty = rows.filter(([value]) => value === "");
      const full = rows.filter(([value]) => value !== "").sort(([a], [b]) => (ascending ? order(a, b) : order(b, a)));
      body.append(...full.concat(empty).map(([, row]) => row));
      heads.forEach((each) => each.removeAttribute("aria-sort"));
      head.setAttribute("aria-sort", ascending ? "ascending" : "descending");
    });
  });
}
