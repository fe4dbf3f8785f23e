// The connection to the server: what it tells, and what is asked of it.

const RETRY_MS = 1000;
const SILENCE_MS = 1500;  // a state comes every 50 ms
const ANSWER_MS = 1800;  // then the server refuses what may raise motion, for the state is too old

const ALWAYS = ["stop", "pause", "cancel"];  // however late they arrive

/** Keeps a stream of events open, with the description of the server that answers. */
export class Link {
  /** `hear` has describe(description), lost(text) and one function for each kind of event. */
  constructor(hear) {
    this.hear = hear;
    this.token = "";
    this.seen = "";  // when the newest state was told
    this.why = "";
    this.heard = this.opened = performance.now();
    this.opens = true;  // or will, after a while
    this.others = new AbortController();
    setInterval(() => this.watch(), 250);
    this.open();
  }

  async open() {
    try {
      await this.identify();
      this.listen();
      this.opens = false;
    } catch (error) {
      this.opens = false;
      this.retry("connection lost: the server does not answer");
    }
  }

  /** Reads the token, and the description if it is another server's. */
  async identify() {
    const answer = await fetch("robot.json", { cache: "no-store", signal: AbortSignal.timeout(ANSWER_MS) });
    if (!answer.ok) throw new Error(await answer.text());
    const description = await answer.json();
    if (description.token === this.token) return;
    this.token = description.token;
    this.hear.describe(description);
  }

  listen() {
    this.opened = performance.now();
    this.stream = new EventSource("events?token=" + encodeURIComponent(this.token));
    this.stream.onerror = () => this.retry("connection lost: the server has closed it, or there are too many browsers");
    for (const kind of ["state", "ports", "answer", "report", "event"]) {
      this.stream.addEventListener(kind, (event) => {
        const message = JSON.parse(event.data);
        if (kind === "state") this.alive(message);
        this.hear[kind](message);
      });
    }
  }

  alive(state) {
    this.heard = performance.now();
    this.seen = state.seen;
    this.why = "";
  }

  /** Says what is wrong, and begins anew a little later. */
  retry(text) {
    if (this.stream) this.stream.close();
    this.why = text;
    this.hear.lost(text);
    if (this.opens) return;
    this.opens = true;
    setTimeout(() => this.open(), RETRY_MS);
  }

  /** A stream may be silent without an end, as through a forward that has died: it is opened anew. */
  watch() {
    const now = performance.now(), silent = now - this.heard;
    if (silent <= SILENCE_MS) return;
    this.hear.lost(`${this.why || "connection lost"}; no state for ${(silent / 1000).toFixed(0)} s`);
    if (now - this.opened > SILENCE_MS) this.retry(this.why || "connection lost: the server is silent");
  }

  /** Sends a command; returns {number} of the answer to come. Throws the text of a refusal. */
  async send(command, body = "") {
    let answer = await this.post(command, body);
    if (answer.status === 403 && command === "stop") {  // the server was started anew
      await this.identify().catch(() => {});
      answer = await this.post(command, body);
    }
    if (!answer.ok) throw new Error(await answer.text());
    return answer.json();
  }

  /** A browser has few connections: a stop does not wait for those of other commands. */
  async post(command, body) {
    const stops = command === "stop", late = AbortSignal.timeout(ANSWER_MS);
    if (stops) this.others.abort();
    if (stops) this.others = new AbortController();
    const signal = stops ? late : AbortSignal.any([late, this.others.signal]);
    const headers = { "X-Tactus-Token": this.token, "X-Tactus-Seen": this.seen };
    try {
      return await fetch(command, { method: "POST", body, headers, signal });
    } catch (error) {
      if (!signal.aborted) throw new Error("no answer: there is no connection to the server, and perhaps it was not sent");
      if (!late.aborted) throw new Error("given up for the stop");
      throw new Error(`no answer yet; ${ALWAYS.includes(command) ? "carried out when the server takes it" : "void when it comes"}`);
    }
  }
}
