/** The export dialog: figure, table, command line, Python. */

import * as api from "./api.js";
import { byId, choice, element } from "./dom.js";
import { Latest } from "./latest.js";
import { valueOf } from "./parameters.js";
import {
  attractorsPlan, basinPlan, diagramPlan, lyapunovPlan, mapPlan, over, settlePlan, simulatePlan, within,
} from "./plans.js";
import { asShown, planValue } from "./units.js";

/** Width of figures for print, in the units of the server. */
const WIDTH = 1000;

/** Numbers of points along each axis of a view. */
const POINTS = [100, 200, 400, 800];

export class Export {
  /**
   * @param {import("./state.js").Store} store
   * @param {{plane: import("./plane.js").Plane, basin: () => import("./basin.js").Basin}} views
   */
  constructor(store, views) {
    Object.assign(this, { store, views, dialog: byId("export") });
    this.choice = element("select", { id: "export-view", onchange: () => this.refresh() });
    this.points = choice({ id: "export-points", onchange: () => this.refresh() }, POINTS.map((n) => [n, `${n} × ${n}`]));
    this.points.value = "200";
    this.pointsRow = element("label", { class: "row" }, element("span", { text: "points" }), this.points);
    this.said = element("p", { class: "note", role: "status" });
    this.files = element("div", { class: "buttons" }, ...["svg", "png", "csv"].map((format) =>
      element("button", { type: "button", "data-format": format, text: format.toUpperCase(), onclick: () => this.save(format) })));
    this.commands = { vibro: this.command("Command line"), python: this.command("Python") };
    byId("export-body").append(
      element("label", { class: "row" }, element("span", { text: "view" }), this.choice), this.pointsRow, this.files, this.said,
      this.commands.vibro.box, this.commands.python.box,
    );
    this.asked = new Latest((asked, signal) => this.tell(asked, signal), (error) => this.failed(error));
    byId("export-button").addEventListener("click", () => this.open("plane"));
  }

  command(title) {
    const code = element("pre", { class: "code", tabindex: "0", role: "region", "aria-label": title });
    const copy = element("button", { type: "button", class: "quiet", text: "Copy", "aria-label": `Copy ${title}` });
    copy.addEventListener("click", async () => {
      try {
        await navigator.clipboard.writeText(code.textContent);
        this.said.textContent = `${title} copied.`;
      } catch {
        getSelection().selectAllChildren(code);
        this.said.textContent = `${title} selected: the browser does not let a page copy it.`;
      }
    });
    const box = element("section", { class: "command" },
      element("header", { class: "head" }, element("h3", { text: title }), copy), code);
    return { box, code };
  }

  /** The views that can be exported now: name, plan, kind of figure. */
  list() {
    const { state } = this.store;
    const n = Number(this.points.value);
    const span = (view, make) => {
      const [l, r, b, t] = view.viewport.window();
      const { legal, x, y } = view.source;
      const cut = (range, coordinate, low, high) => over(...within(range, coordinate, low, high), n);
      return make(state, cut(legal.x, x, l, r), cut(legal.y, y, b, t));
    };
    const views = {
      plane: {
        name: "map", plan: () => span(this.views.plane.view, mapPlan), points: true,
        drawn: () => ({ ...this.over(), ...this.colours(this.views.plane.view) }),
      },
    };
    if (state.point) {
      const settle = () => settlePlan(state);
      Object.assign(views, {
        waveform: { name: "waveform", plan: () => simulatePlan(state), kind: "waveform" },
        basin: {
          name: "basin: which start leads where", plan: () => span(this.views.basin().view, basinPlan), points: true,
          drawn: () => this.colours(this.views.basin().view), needs: () => this.views.basin().view.source,
        },
        attractors: { name: "motions that coexist", plan: () => attractorsPlan(state), tableOnly: true },
        steady: { name: "steady motion", plan: settle, kind: "waveform" },
        phase: { name: "phase portrait", plan: settle, kind: "phase" },
        multipliers: { name: "multipliers", plan: settle, kind: "multipliers" },
        sections: { name: "impact map and section", plan: settle, kind: "sections" },
        lyapunov: { name: "Lyapunov exponents and attractor", plan: () => lyapunovPlan(state), kind: "sections" },
      });
    }
    if (state.line) {
      views.line = {
        name: "bifurcation diagram", plan: () => diagramPlan(state, 2 * n), points: true,
        note: "With the branches. The call in Python has the points from simulation only.",
      };
    }
    return Object.fromEntries(Object.entries(views).filter(([, view]) => !view.needs || view.needs()));
  }

  /** The quantity whose values are the colours of a view, and their range. */
  colours({ source, range }) {
    if (!source?.quantity) return {};
    const { name, of, per } = source.quantity;
    // plans and commands have metres
    return { colour: name, of, range: range?.map((end) => Number((end / per).toPrecision(15))).join() };
  }

  /** What lies over the map: layers, the chosen point, the line. */
  over() {
    const { state } = this.store;
    // coordinates in the units of the axes of the plan
    const inPlan = (values) => values.map((value, k) => planValue(state, k % 2 ? state.y : state.x, value)).join();
    return {
      layers: state.layers.join(),
      mark: state.point ? inPlan([valueOf(state, state.x), valueOf(state, state.y)]) : null,
      line: state.line && state.panel === "line" ? inPlan(state.line) : null,
    };
  }

  /** @param {string} view the view selected initially */
  open(view) {
    const views = this.list();
    this.choice.replaceChildren(...Object.entries(views).map(([value, { name }]) => element("option", { value, text: name })));
    this.choice.value = view in views ? view : "plane";
    this.dialog.showModal();
    this.refresh();
  }

  refresh() {
    this.view = this.list()[this.choice.value];
    this.plan = asShown(this.view.plan(), this.store.state);
    this.pointsRow.hidden = !this.view.points;
    // a diagram has twice as many values along its line
    const along = this.choice.value === "line";
    for (const option of this.points.options) option.text = along ? `${2 * option.value} values` : `${option.value} × ${option.value}`;
    for (const button of this.files.children) {
      button.hidden = Boolean(this.view.tableOnly) && button.dataset.format !== "csv";
    }
    this.said.textContent = this.view.note ?? "";
    this.asked.ask({ plan: this.plan, query: { kind: this.view.kind, ...this.view.drawn?.() } }, true);
  }

  async tell({ plan, query }, signal) {
    for (const { code } of Object.values(this.commands)) code.textContent = "";
    const told = await api.command(plan, query, signal);
    // the figure and the table of a view may need commands of their own
    this.commands.vibro.code.textContent = [this.choice.value === "line" ? null : told.vibro, told.figure].filter((text) => text).join("\n");
    this.commands.python.code.textContent = told.python;
  }

  async save(format) {
    const { plan } = this;
    const name = `vibro-${this.choice.value}.${format}`;
    this.said.textContent = "computing";
    try {
      this.download(await this.blob(format, plan), name);
      this.said.textContent = `${name} saved.`;
    } catch (error) {
      this.failed(error);
    }
  }

  async blob(format, plan) {
    if (format === "csv") return this.choice.value === "line" ? api.bifurcationTable(plan) : api.table(plan, this.view.kind);
    if (this.choice.value === "line") return api.bifurcationFigure(plan, { format, width: WIDTH, height: 0.7 * WIDTH });
    return api.figure(plan, { format, width: WIDTH, kind: this.view.kind, ...this.view.drawn?.() });
  }

  download(blob, name) {
    const address = URL.createObjectURL(blob);
    element("a", { href: address, download: name }).click();
    setTimeout(() => URL.revokeObjectURL(address), 10000);
  }

  failed(error) {
    this.said.textContent = error.message;
  }
}
