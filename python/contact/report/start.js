// The start page of `contact report --serve`: folders, experiments, the current run, the text of an input, the form.
const byId = id => document.getElementById(id);
const page = { folder: "", running: false, stream: null, begun: 0, title: "Messages", opener: "" };

function element(tag, text, name) {
  const e = document.createElement(tag);
  if (text !== undefined) e.textContent = text;
  if (name) e.className = name;
  return e;
}
function button(text, action, label) {
  const b = element("button", text);
  b.type = "button";
  b.onclick = action;
  if (label) b.setAttribute("aria-label", label);
  return b;
}
const ask = (path, values) => fetch(path + "?" + new URLSearchParams(values));

// ---------------------------------------------------------------- folders and experiments

// State of a result in words, and whether it is complete with all cases solved
function resultState(file) {
  if (file.result === "none") return ["not run yet", true];
  const run = file.run,
    age = file.result === "old" ? "result is older than the input" : "result is up to date";
  if (!run) return [age, true];
  if (!run.complete)
    return [
      `not complete: ${run.cases_finished} of ${run.input_readable ? "" : "at least "}${run.cases_planned} cases` +
        (file.result === "old" ? "; older than the input" : ""),
      false,
    ];
  const bad = (run.not_converged || 0) + (run.refused || 0);
  return [
    age +
      `, ${run.cases_finished} case${run.cases_finished === 1 ? "" : "s"}` +
      (bad ? `, ${bad} of them refused or not converged` : ""),
    !bad,
  ];
}
async function list() {
  const answer = await ask("/files", { folder: page.folder });
  if (!answer.ok) {
    page.folder = "";
    return answer.status === 404 ? list() : undefined;
  }
  const found = await answer.json(),
    table = byId("files"),
    focused = table.parentElement.contains(document.activeElement) ? labelOf(document.activeElement) : "";
  showWay(found.folders);
  offerBeside(found.files.filter(file => file.result !== "none"));
  table.replaceChildren();
  if (!found.files.length) table.append(element("caption", "There is no input in this folder."));
  for (const file of found.files) table.append(rowOf(file));
  if (focused) focusOn(focused);
  return undefined;
}
// The list is rebuilt on changes; keyboard focus is restored
const labelOf = e => e.getAttribute("aria-label") || e.textContent;
function focusOn(label) {
  const buttons = [...byId("list").querySelectorAll("button, a, select")];
  (buttons.find(e => labelOf(e) === label) || buttons[0]).focus();
}
function rowOf(file) {
  const row = element("tr"),
    name = element("th", file.name.split("/").pop()),
    actions = element("td", undefined, "do");
  const [text, whole] = resultState(file),
    about = element("span", new Date(1000 * file.changed).toLocaleString() + " \u00b7 ", "about");
  row.dataset.name = file.name;
  name.scope = "row";
  about.append(element("span", text, whole ? "" : "warn"));
  name.append(about);
  for (const form of file.formats)
    actions.append(
      button(file.formats.length > 1 ? "." + form : "input", () => showInput(file.name, form), `input ${file.name}.${form}`),
    );
  for (const mode of ["check", "run"]) {
    const b = button(mode, () => begin(mode, file.name), `${mode} ${file.name}`);
    // the attribute disabled would remove the focus
    b.setAttribute("aria-disabled", page.running);
    actions.append(b);
  }
  if (file.result !== "none") {
    const link = element("a", "show", "button"),
      other = byId("beside").value;
    link.href =
      "/result?" + new URLSearchParams(other && other !== file.name ? { name: file.name, with: other } : { name: file.name });
    link.target = "_blank";
    link.rel = "noopener";
    link.setAttribute("aria-label", `show ${file.name}`);
    actions.append(link);
  }
  row.append(name, actions);
  return row;
}
function showWay(folders) {
  const parts = page.folder ? page.folder.split("/") : [],
    items = [];
  const enter = (text, folder, label) => {
    const b = button(text, () => enterFolder(folder), label);
    b.className = "link";
    items.push(b);
  };
  if (parts.length) enter("top", "", "top folder");
  parts.forEach((part, k) => {
    items.push(element("span", "/"));
    if (k + 1 < parts.length) enter(part, parts.slice(0, k + 1).join("/"));
    else items.push(element("b", part));
  });
  if (parts.length && folders.length) items.push(element("span", "\u00b7"));
  for (const name of folders) enter(name + "/", [...parts, name].join("/"), `folder ${name}`);
  byId("way").hidden = !items.length;
  byId("way").replaceChildren(...items);
}
function enterFolder(folder) {
  if (folder === page.folder) return list();
  page.folder = folder;
  history.pushState(null, "", folder ? "#" + encodeURIComponent(folder) : location.pathname);
  return list();
}
function readAddress() {
  try {
    page.folder = decodeURIComponent(location.hash.slice(1));
  } catch {
    page.folder = "";
  }
}
function offerBeside(files) {
  const select = byId("beside"),
    keep = select.value;
  select.replaceChildren(new Option("none", ""), ...files.map(file => new Option(file.name, file.name)));
  select.value = files.some(file => file.name === keep) ? keep : "";
  byId("beside-bar").hidden = files.length < 2;
}

// ---------------------------------------------------------------- the run

function showState(text, kind) {
  byId("state").textContent = text;
  byId("state").className = "state " + (kind || "");
}
function show(what) {
  page.opener = document.activeElement === document.body ? "" : labelOf(document.activeElement);
  for (const id of ["messages", "input", "form"]) byId(id).hidden = id !== what;
  byId("back").hidden = what === "messages";
  if (innerWidth <= 900) byId("side").scrollIntoView();
}
async function begin(mode, name) {
  if (page.running) return undefined;
  const answer = await fetch(`/${mode}?name=${encodeURIComponent(name)}`, { method: "POST" });
  show("messages");
  if (!answer.ok) return showState(await answer.text(), "bad");
  return follow({ mode, name, done: false, seconds: 0 });
}
// Show all messages of the job, new or already running
function follow(job) {
  if (page.stream) page.stream.close();
  byId("what").textContent = page.title = `${job.mode === "run" ? "Run" : "Check"} of ${job.name}`;
  byId("messages").replaceChildren();
  page.running = !job.done;
  page.begun = Date.now() - 1000 * job.seconds;
  byId("stop").disabled = job.done;
  byId("stop").textContent = job.stopping ? "stop at once" : "stop";
  showState(job.done ? "" : "running \u2026");
  progress(job);
  const stream = (page.stream = new EventSource("/messages")),
    box = byId("messages");
  stream.addEventListener("line", event => {
    const text = JSON.parse(event.data),
      end = box.scrollTop + box.clientHeight > box.scrollHeight - 40;
    box.append(element("span", text + "\n", /ERROR/.test(text) ? "error" : ""));
    while (box.childElementCount > 20000) box.firstChild.remove();
    if (end) box.scrollTop = box.scrollHeight;
  });
  stream.addEventListener("progress", event => progress(JSON.parse(event.data)));
  stream.addEventListener("end", event => {
    stream.close();
    ended(JSON.parse(event.data));
  });
  list();
}
function ended(status) {
  page.running = false;
  page.stream = null;
  byId("stop").disabled = true;
  byId("stop").textContent = "stop";
  byId("progress").hidden = true;
  const text = status === 0 ? "finished" : status < 0 || status > 128 ? "stopped" : "finished with errors";
  showState(text, status === 0 ? "good" : "bad");
  list();
}
function progress(job) {
  const bar = byId("progress"),
    finished = Math.max(0, job.begun - 1);
  if (!page.running || job.begun === undefined) return;
  bar.hidden = !job.planned;
  if (job.planned) {
    bar.max = job.planned;
    bar.value = finished;
  }
  if (!job.begun) return;
  const seconds = (Date.now() - page.begun) / 1000,
    left = job.planned && finished ? (seconds / finished) * (job.planned - finished) : 0;
  const time = s => (s < 90 ? `${Math.ceil(s)} s` : `${Math.round(s / 60)} min`);
  showState(
    `case ${job.begun}${job.planned ? " of " + job.planned : ""}` + (left >= 2 ? `, about ${time(left)} left` : "") + " \u2026",
  );
}
async function resume() {
  const job = await (await fetch("/job")).json();
  if (job) follow(job);
}

// ---------------------------------------------------------------- input

async function showInput(name, form) {
  const answer = await ask("/input", { name, format: form }),
    text = await answer.text();
  byId("input").textContent = text;
  byId("input").setAttribute("aria-label", `input ${name}.${form}`);
  byId("what").textContent = `${name}.${form}`;
  show("input");
  byId("input").scrollTop = 0;
  byId("input").focus({ preventScroll: true });
}

// ---------------------------------------------------------------- a new experiment

let offer = null;
async function openForm() {
  offer = await (await ask("/form", { folder: page.folder })).json();
  byId("what").textContent = "New experiment" + (page.folder ? ` in ${page.folder}` : "");
  show("form");
  drawForm(Object.keys(offer.kinds)[0]);
}
function line(label, input, unit) {
  const l = element("label", label);
  l.htmlFor = input.id;
  return [l, input, element("span", unit || "", "unit")];
}
function select(id, options) {
  const s = element("select");
  s.id = id;
  s.append(...options.map(([value, text]) => new Option(text, value)));
  return s;
}
function field(id, value) {
  const input = element("input");
  input.id = id;
  input.value = value;
  input.autocomplete = "off";
  if (typeof value === "number") input.inputMode = "decimal";
  return input;
}
function drawForm(kind) {
  const { title, fields, vary } = offer.kinds[kind],
    rows = [],
    first =
      title &&
      select(
        "new-kind",
        Object.entries(offer.kinds).map(([k, v]) => [k, v.title]),
      );
  first.value = kind;
  first.onchange = () => drawForm(first.value);
  rows.push(
    ...line("What", first),
    ...line("Name", field("new-name", "")),
    ...line(
      "Format",
      select(
        "new-format",
        offer.formats.map(f => [f, "." + f]),
      ),
    ),
  );
  for (const [name, label, third, value] of fields) {
    const profiles = third === "profile",
      choices = Array.isArray(third) ? third : profiles ? offer.profiles.map(p => [p, p]) : null;
    const box = choices ? select("new-" + name, choices) : field("new-" + name, value);
    if (profiles) box.value = offer.profiles.find(p => value.some(end => p.toLowerCase().endsWith(end))) || offer.profiles[0];
    rows.push(...line(label, box, choices ? "" : third));
  }
  const named = Object.keys(vary).map(name => [name, fields.find(f => f[0] === name)[1]]);
  rows.push(
    ...line("Varies from case to case", select("new-vary", [["", "nothing, one case"], ...named])),
    ...line("to", field("new-to", 0)),
    ...line("in cases", field("new-count", 11)),
  );
  const send = element("button", "write the input"),
    answer = element("p", "", "whole");
  answer.id = "new-answer";
  answer.setAttribute("role", "status");
  answer.style.margin = "0";
  answer.style.whiteSpace = "pre-wrap";
  send.type = "submit";
  send.className = "whole";
  byId("form").replaceChildren(...rows, send, answer);
  const varied = byId("new-vary");
  varied.onchange = () => {
    for (const id of ["new-to", "new-count"]) byId(id).disabled = !varied.value;
  };
  varied.onchange();
  first.focus({ preventScroll: true });
  if (fields.some(f => f[2] === "profile") && !offer.profiles.length)
    answer.textContent = "There are no profiles in this folder: put them into it, or into a subfolder.";
}
async function sendForm() {
  const kind = byId("new-kind").value,
    vary = byId("new-vary").value,
    values = {},
    number = id => (byId(id).value.trim() === "" ? NaN : Number(byId(id).value.replace(",", ".")));
  for (const [name, , third] of offer.kinds[kind].fields)
    values[name] = typeof third === "string" && third !== "profile" ? number("new-" + name) : byId("new-" + name).value;
  const body = {
    kind,
    folder: page.folder,
    name: byId("new-name").value.trim(),
    format: byId("new-format").value,
    values,
    vary,
    to: vary ? number("new-to") : 0,
    count: vary ? number("new-count") : 1,
  };
  const answer = await fetch("/new", { method: "POST", body: JSON.stringify(body) }),
    box = byId("new-answer");
  box.className = "whole" + (answer.ok ? "" : " error");
  if (!answer.ok) {
    box.textContent = await answer.text();
    box.scrollIntoView({ block: "nearest" });
    return;
  }
  const made = await answer.json();
  box.textContent = [
    `${made.name} is written.`,
    ...made.messages
      .trim()
      .split("\n")
      .map(text => text.trim()),
    "",
  ].join("\n");
  box.append(button("run it", () => begin("run", made.name)));
  box.scrollIntoView({ block: "nearest" });
  list();
}

byId("stop").onclick = () => {
  fetch("/stop", { method: "POST" });
  byId("stop").textContent = "stop at once";
};
byId("back").onclick = () => {
  const opener = page.opener;
  byId("what").textContent = page.title;
  show("messages");
  focusOn(opener);
};
byId("fresh").onclick = openForm;
byId("form").onsubmit = event => {
  event.preventDefault();
  sendForm();
};
byId("beside").onchange = list;
addEventListener("popstate", () => {
  readAddress();
  list();
});
readAddress();
list();
resume();
