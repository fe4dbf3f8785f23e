// The connection to the server: what it tells, and what is asked of it.

const RETRY_MS = 1000;
const SILENCE_MS = 1500;  // a state comes every 50 ms

/** Keeps a stream of events open, with a new description after every loss. */
export class Link {
  /** `hear` has describe(description), lost(text) and one function for each kind of event. */
  constructor(hear) {
    this.hear = hear;
    this.token = "";
    this.heard = 0;
    this.waits = false;
    setInterval(() => this.watch(), 250);
    this.open();
  }

  async open() {
    this.waits = false;
    try {
      const answer = await fetch("robot.json", { cache: "no-store" });
      if (!answer.ok) throw new Error(await answer.text());
      const description = await answer.json();
      this.token = description.token;
      this.hear.describe(description);
      this.listen();
    } catch (error) {
      this.retry("connection lost: the server does not answer");
    }
  }

  listen() {
    this.stream = new EventSource("events?token=" + encodeURIComponent(this.token));
    this.stream.onerror = () => this.retry("connection lost: the server has closed it, or there are too many browsers");
    for (const kind of ["state", "ports", "answer", "report", "event"]) {
      this.stream.addEventListener(kind, (event) => {
        if (kind === "state") this.heard = performance.now();
        this.hear[kind](JSON.parse(event.data));
      });
    }
  }

  /** Says what is wrong, and begins anew a little later. */
  retry(text) {
    if (this.stream) this.stream.close();
    this.hear.lost(text);
    if (this.waits) return;
    this.waits = true;
    setTimeout(() => this.open(), RETRY_MS);
  }

  watch() {
    const silent = performance.now() - this.heard;
    if (this.heard > 0 && silent > SILENCE_MS) this.hear.lost(`no state for ${(silent / 1000).toFixed(0)} s`);
  }

  /** Sends a command; returns {number} of the answer to come. Throws the text of a refusal. */
  async send(command, body = "") {
    let answer;
    try {
      answer = await fetch(command, { method: "POST", body, headers: { "X-Tactus-Token": this.token } });
    } catch (error) {
      throw new Error("the server does not answer");
    }
    if (!answer.ok) throw new Error(await answer.text());
    return answer.json();
  }
}
