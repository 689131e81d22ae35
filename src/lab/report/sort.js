// Tables of data are sorted by a click on a column's name; without this script they stay as they are.
for (const table of document.querySelectorAll("table.data")) {
  const body = table.tBodies[0];
  const value = (row, k) => row.cells[k].dataset.v ?? row.cells[k].textContent;
  const compare = (a, b) => {
    const [x, y] = [a, b].map((text) => (text === "inf" ? Infinity : Number(text)));
    const numbers = a !== "" && b !== "" && !Number.isNaN(x) && !Number.isNaN(y);
    return numbers ? (x === y ? 0 : x - y) : a.localeCompare(b, "en");
  };
  [...table.tHead.rows[0].cells].forEach((head, k) => {
    const button = document.createElement("button");
    button.append(...head.childNodes);
    head.append(button);
    button.addEventListener("click", () => {
      const falling = head.getAttribute("aria-sort") === "ascending";
      for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
      head.setAttribute("aria-sort", falling ? "descending" : "ascending");
      // What is empty comes last, whichever way.
      const filled = (row) => value(row, k) !== "";
      const rows = [...body.rows];
      const sorted = rows.filter(filled).sort((a, b) => compare(value(a, k), value(b, k)));
      if (falling) sorted.reverse();
      body.append(...sorted, ...rows.filter((row) => !filled(row)));
    });
  });
}
