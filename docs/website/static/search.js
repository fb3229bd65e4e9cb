// Search the sections of the site for all words of a question. `SECTIONS` comes from search_index.js: for each
// section its page, anchor, title of the page, heading, and text.

const MOST = 50;
const AROUND = 90; // characters of an excerpt on each side
const LAST = /^(CHANGELOG|CONTRIBUTING|notebooks|plans|examples|handeye)\b/; // pages that come after all others

const plain = (text) => text.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
// a word of the text may go on after a word of the question, except after a number
const beginning = (word) =>
  new RegExp(`(?<![\\p{L}\\p{N}])${plain(word)}${/\d$/.test(word) ? "(?![\\p{L}\\p{N}])" : ""}`, "iu");

// what a heading names: `a seed` in `What a seed is`, one deadlock in `Deadlocks`
const named = (heading) =>
  heading
    .toLowerCase()
    .replace(/^what (an? |the )?(.*) is$/, "$2")
    .replace(/s$/, "");

function search(question) {
  const words = question.trim().split(/\s+/).filter(Boolean).map(beginning);
  if (words.length === 0) return [];
  const asked = question.trim().replace(/\s+/g, " ");
  const phrase = beginning(asked);
  const rated = [];
  for (const section of SECTIONS) {
    const [page, , title, heading, text] = section;
    const whole = `${title}\n${heading}\n${text}`;
    if (!words.every((word) => word.test(whole))) continue;
    const every = (part) => words.every((word) => word.test(part));
    const times = text.split(phrase).length - 1;
    const density = times / (times + text.length / 500 + 1); // below 1
    const inHeading = 16 * (named(heading) === named(asked)) + 16 * phrase.test(heading) + 8 * every(heading);
    const inTitle = 4 * phrase.test(title) + 2 * every(title);
    const rating = inHeading + inTitle + (times > 0) + density - 32 * LAST.test(page);
    rated.push([rating, section]);
  }
  return rated.sort(([a], [b]) => b - a).map(([, section]) => [section, excerpt(section[4], [phrase, ...words])]);
}

function excerpt(text, patterns) {
  const found = patterns.map((pattern) => pattern.exec(text)).find(Boolean);
  if (!found) return [text.length > 2 * AROUND ? text.slice(0, 2 * AROUND).replace(/\s?\S*$/, " …") : text, "", ""];
  const [start, end] = [found.index, found.index + found[0].length];
  const [first, last] = [Math.max(0, start - AROUND), Math.min(text.length, end + AROUND)];
  // no part of a word at the edges
  const before = first > 0 ? text.slice(first, start).replace(/^\S*\s?/, "… ") : text.slice(first, start);
  const after = last < text.length ? text.slice(end, last).replace(/\s?\S*$/, " …") : text.slice(end, last);
  return [before, text.slice(start, end), after];
}

function element(name, ...children) {
  const made = document.createElement(name);
  made.append(...children);
  return made;
}

function result([[page, anchor, title, heading], [before, found, after]]) {
  const link = element("a", heading === title ? title : `${title}: ${heading}`);
  link.href = anchor ? `${page}#${anchor}` : page;
  return element("li", link, element("p", before, element("mark", found), after));
}

const question = new URLSearchParams(location.search).get("q") ?? "";
document.getElementById("words").value = question;
if (question.trim()) {
  const found = search(question);
  const shown = found.slice(0, MOST);
  const some = found.length === 1 ? "1 section contains" : `${found.length || "No"} sections contain`;
  const first = found.length > MOST ? ` These are the first ${MOST}.` : "";
  document.getElementById("found").textContent = `${some} “${question}”.${first}`;
  document.getElementById("results").append(...shown.map(result));
}
