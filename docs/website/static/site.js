// Let the keyboard reach what scrolls within the page.
addEventListener("load", () => {
  for (const box of document.querySelectorAll("pre, .table-wrapper, .output")) {
    if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
  }
});
