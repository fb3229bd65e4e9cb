// The tables in a live page: what the server sends, and words that the user writes.
(() => {
  "use strict";
  const { byId } = live;
  let picked = null;

  tables.live((number) => {
    picked = tables.place(number);
    byId("tables-word").value = "";
  });
  byId("tables-write").addEventListener("submit", (event) => {
    event.preventDefault();
    if (picked === null) return;
    const { side, table, line, word } = picked;
    live.say(`type ${side} FILE ${table} ${line} ${word} ${byId("tables-word").value}`);
    byId("tables-word").value = "";
  });
  live.hear({ tables: (changes, { passed, restarted }) => tables.feed(changes, passed, restarted) });
})();
