// Names for what the theme leaves without: the search, navigation of which there are several, and tables that scroll.
document$.subscribe(() => {
  document.querySelector(".md-search")?.setAttribute("aria-label", "Search");
  document.querySelectorAll(".md-typeset__scrollwrap").forEach(each => each.setAttribute("tabindex", "0"));
  document.querySelectorAll(".md-nav[data-md-level='1']").forEach(each => {
    each.removeAttribute("aria-labelledby");
    each.setAttribute("aria-label", "Pages");
  });
  const label = () => document.querySelectorAll(".md-code__nav").forEach(
    (each, number) => each.setAttribute("aria-label", `Code ${number + 1}`));
  new MutationObserver(label).observe(document.body, {childList: true, subtree: true});
  label();
});
