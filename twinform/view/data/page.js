// What viser's client leaves out: the name of what the mouse is over, and a tree whose rows can be clicked.
// `twinform.labels` are texts by the names of viser's nodes, `twinform.selected` the names of links.
// Names are set as text only. Where the client is another one than we know, there are no names on hover.
"use strict";
(() => {
  const REST = 40; // milliseconds that the mouse rests before it is looked what it is over
  const page = (window.twinform ??= { labels: {}, selected: [] });
  if (page.show) return;

  const tip = document.createElement("div");
  tip.id = "twinform-tip";
  tip.setAttribute("role", "tooltip");
  tip.style.cssText =
    "position:fixed;z-index:1000;display:none;pointer-events:none;max-width:24em;padding:0.3em 0.6em;" +
    "border-radius:4px;background:#222d;color:#fff;font:13px/1.35 system-ui,sans-serif;" +
    "white-space:pre-line;overflow-wrap:anywhere";
  document.body.append(tip);

  function say(text, x, y) {
    tip.style.display = text ? "block" : "none";
    if (!text) return;
    tip.textContent = text;
    tip.style.left = `${Math.max(0, Math.min(x + 14, innerWidth - tip.offsetWidth - 4))}px`;
    tip.style.top = `${y + 18 + tip.offsetHeight > innerHeight ? Math.max(0, y - tip.offsetHeight - 8) : y + 18}px`;
  }

  /** The label of a node, or of the nearest one around it that has one. */
  function label(name) {
    for (; name; name = name.slice(0, name.lastIndexOf("/"))) {
      if (Object.hasOwn(page.labels, name)) return page.labels[name];
    }
    return "";
  }

  /** The label of what is drawn at a place of the window. */
  function under(client, x, y) {
    const names = new Map(Object.entries(client.nodeRefFromName).map(([name, node]) => [node, name]));
    const box = client.canvas.getBoundingClientRect();
    const { raycaster } = client.scene.__r3f.root.getState();
    const at = { x: ((x - box.left) / box.width) * 2 - 1, y: 1 - ((y - box.top) / box.height) * 2 };
    raycaster.setFromCamera(at, client.camera);
    let nearest = { distance: Infinity, text: "" };
    const look = (object, text) => {
      if (!object.visible) return;
      text = names.has(object) ? label(names.get(object)) : text;
      if (text) {
        for (const { distance } of raycaster.intersectObject(object, false)) {
          if (distance < nearest.distance) nearest = { distance, text };
        }
      }
      object.children.forEach((child) => look(child, text));
    };
    look(client.scene, "");
    return nearest.text;
  }

  let rest;
  addEventListener("pointermove", (event) => {
    clearTimeout(rest);
    const client = window.__viserMutable;
    if (!client?.canvas || event.buttons || !client.canvas.parentElement?.contains(event.target)) return say("");
    rest = setTimeout(() => {
      let text = "";
      try {
        text = under(client, event.clientX, event.clientY);
      } catch (error) {
        console.info("twinform: no names on hover:", error);
      }
      say(text, event.clientX, event.clientY);
    }, REST);
  }, true);
  for (const event of ["pointerdown", "wheel", "pointerleave", "blur"]) {
    addEventListener(event, () => { clearTimeout(rest); say(""); }, true);
  }

  // A row of the tree puts the name of its link into the field above, as a person would type it.
  document.addEventListener("click", (event) => {
    const row = event.target.closest?.("[data-twinform-link]");
    let around = row;
    while (around && !around.querySelector("input")) around = around.parentElement;
    const field = around?.querySelector("input");
    if (!field) return;
    event.preventDefault();
    const set = Object.getOwnPropertyDescriptor(HTMLInputElement.prototype, "value").set;
    set.call(field, "");
    field.dispatchEvent(new Event("input", { bubbles: true }));
    set.call(field, row.dataset.twinformLink);
    field.dispatchEvent(new Event("input", { bubbles: true }));
  });

  function mark() {
    for (const row of document.querySelectorAll("[data-twinform-link]")) {
      const is = page.selected.includes(row.dataset.twinformLink);
      if (is === (row.getAttribute("aria-current") === "true")) continue;
      row.setAttribute("aria-current", is);
      if (!is) continue;
      for (let up = row.closest("details"); up; up = up.parentElement?.closest("details")) up.open = true;
      if (row.offsetParent) row.scrollIntoView({ block: "nearest" });
    }
  }
  // rows come and go with the tab that they are in
  let due = 0;
  new MutationObserver(() => {
    due ||= requestAnimationFrame(() => { due = 0; mark(); });
  }).observe(document.body, { childList: true, subtree: true });

  page.show = (news) => {
    Object.assign(page, news);
    if (news.title) document.title = news.title;
    say("");
    mark();
  };
})();
