/** Requests to the server. Errors have the messages of the server. */

/** The server refused the request; the message states the reason. */
export class ServerError extends Error {}

/** The server does not answer. */
export class ServerGone extends Error {
  constructor() {
    super("The server has stopped; start `vibro explore` again.\nThe page continues as soon as it answers.");
  }
}

/** The number of requests for answers, figures and layers that are under way. */
export const pending = {
  count: 0,
  heard: [],
  listen(heard) {
    this.heard.push(heard);
  },
  add(n) {
    this.count += n;
    for (const heard of this.heard) heard();
  },
};

/** Requests that someone waits for; tiles, coarse pictures and the first request of the page are none. */
const waitedFor = (path) => !["/api/tile", "/api/whole", "/api/picture", "/api/about"].some((other) => path.startsWith(other));

/** Counts work as pending. */
async function counted(path, work) {
  if (!waitedFor(path)) return work();
  pending.add(1);
  try {
    return await work();
  } finally {
    pending.add(-1);
  }
}

async function ask(path, { body, signal, accept } = {}) {
  const headers = { accept: accept ?? "*/*" };
  if (body !== undefined) headers["content-type"] = "application/json";
  let response;
  try {
    response = await fetch(path, {
      method: body === undefined ? "GET" : "POST", headers, signal,
      body: body === undefined ? undefined : JSON.stringify(body),
    });
  } catch (error) {
    throw error.name === "AbortError" ? error : new ServerGone();
  }
  if (response.ok) return response;
  const told = await response.json().catch(() => null);
  throw new ServerError(told?.error ?? `The server answered ${response.status} ${response.statusText}.`);
}

/** The body of an answer. An interrupted connection is reported as `ServerGone`. */
async function complete(reading) {
  try {
    return await reading;
  } catch (error) {
    throw error.name === "AbortError" ? error : new ServerGone();
  }
}

const withQuery = (path, query) => {
  const given = Object.entries(query).filter(([, value]) => value !== undefined && value !== null);
  return given.length ? `${path}?${new URLSearchParams(given)}` : path;
};

/** The JSON object of an answer. */
const object = async (path, query, body, signal) => complete((await ask(withQuery(path, query), { body, signal })).json());

/** The units of a body. @returns {Promise<{units: object, velocity_m_per_s: number, natural_hz: number}>} */
export const units = (machine, signal) => object("/api/units", machine, undefined, signal);

export const about = async () => (await ask("/api/about")).json();

/**
 * Requests a tile. Returns its header and its fields as typed arrays by name.
 * @param {object} plan
 * @param {AbortSignal} [signal]
 */
export const tile = (plan, signal) => arrays("/api/tile", plan, signal);

/**
 * Requests a tile of a map in which more points are computed than before, or all of them. The field `computed` says which; it
 * is missing when all are.
 * @param {object} plan without refinement
 * @param {{within: number, after: string}} query milliseconds after which no further points begin, and how the tile was computed before
 */
export const whole = (plan, query, signal) => arrays(withQuery("/api/whole", query), plan, signal);

/**
 * Requests a coarse picture within some milliseconds. The plan has its finest grid; the header says how many rows and
 * columns of larger cells the picture has. Returns the same as `tile`.
 */
export const picture = (plan, within, signal) => arrays(withQuery("/api/picture", { within }), plan, signal);

async function arrays(path, plan, signal) {
  const buffer = await complete((await ask(path, { body: plan, signal })).arrayBuffer());
  const length = new DataView(buffer).getUint32(0, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, length)));
  const kinds = { i32: Int32Array, f64: Float64Array, i8: Int8Array };
  const fields = {};
  for (const field of header.fields) {
    const values = new kinds[field.type](buffer, 4 + length + field.offset, field.length);
    fields[field.name] = { values, per: field.per_point };
  }
  return { header, fields };
}

/** The server-sent events of an answer, in order. */
async function* events(response) {
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let text = "";
  for (;;) {
    const { value, done } = await complete(reader.read());
    if (done) return;
    text = (text + value).replaceAll("\r\n", "\n");
    for (let end = text.indexOf("\n\n"); end >= 0; end = text.indexOf("\n\n")) {
      const lines = text.slice(0, end).split("\n");
      text = text.slice(end + 2);
      const part = (name) => lines.filter((l) => l.startsWith(`${name}:`)).map((l) => l.slice(name.length + 1).trim());
      const data = part("data").join("\n");
      if (data) yield { event: part("event")[0] ?? "message", data: JSON.parse(data) };
    }
  }
}

const told = (path, ...given) => counted(path, () => listened(path, ...given));

async function listened(path, plan, signal, onProgress) {
  const response = await ask(path, { body: plan, signal, accept: "text/event-stream" });
  if (!response.headers.get("content-type")?.startsWith("text/event-stream")) return complete(response.json());
  for await (const { event, data } of events(response)) {
    if (event === "progress") onProgress?.(data.total ? data.done / data.total : 0);
    if (event === "error") throw new ServerError(data.error);
    if (event === "done") return data;
  }
  throw new ServerGone();
}

/** @returns {Promise<object>} the object that `vibro TASK --json` prints */
export const answer = (plan, signal, onProgress) => told("/api/answer", plan, signal, onProgress);

/**
 * The motion of a `simulate` plan from its start, or that of a `settle` plan after its transient, as points and events.
 * @returns {Promise<object>}
 */
export const motion = (plan, periods, signal) => counted("/api/motion", () => object("/api/motion", { periods }, plan, signal));

/** @returns {Promise<{svg: string}>} the orbit diagram with its branches */
export const bifurcation = (plan, query, signal, onProgress) =>
  told(withQuery("/api/bifurcation", query), plan, signal, onProgress);

/** @returns {Promise<object>} `regions` or `curves` */
export const layer = (kind, plan, signal, onProgress) =>
  told(withQuery("/api/layer", { kind }), plan, signal, onProgress);

/**
 * @param {object} plan
 * @param {{format: "svg" | "png", width?: number, height?: number, kind?: string}} query
 * @param {AbortSignal} [signal]
 * @returns {Promise<Blob>}
 */
export const figure = (plan, query, signal) => drawn("/api/figure", plan, query, signal);

/** The figure of the orbit diagram with its branches; parameters as for `figure`. */
export const bifurcationFigure = (plan, query, signal) => drawn("/api/bifurcation", plan, query, signal);

const drawn = (path, plan, query, signal) =>
  counted(path, async () => complete((await ask(withQuery(path, query), { body: plan, signal })).blob()));

/** The table of the orbit diagram with its branches. */
export const bifurcationTable = (plan, signal) => drawn("/api/bifurcation", plan, { table: true }, signal);

/** @param {string} [kind] the view of a settled motion whose table is requested */
export const table = (plan, kind, signal) => drawn("/api/table", plan, { kind }, signal);

/**
 * @param {{kind?: string, colour?: string, of?: string, range?: string, layers?: string, mark?: string, line?: string}} query what the figure of the command shows
 * @returns {Promise<{vibro: string, python: string, figure: string | null}>}
 */
export const command = (plan, query, signal) => object("/api/command", query, plan, signal);
