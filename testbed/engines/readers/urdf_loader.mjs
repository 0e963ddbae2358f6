// Loads a URDF file with urdf-loader of npm and prints its links and joints.
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";

const [folder, file] = process.argv.slice(2);
const require = createRequire(folder + "/");
const { JSDOM } = require("jsdom");
const window = new JSDOM("").window;
Object.assign(globalThis, { window, document: window.document, DOMParser: window.DOMParser, Document: window.Document, Element: window.Element });
const { default: URDFLoader } = await import(require.resolve("urdf-loader/src/URDFLoader.js"));
const robot = new URDFLoader().parse(readFileSync(file, "utf8"), "");
const joints = Object.values(robot.joints).map((joint) => [joint.name, joint.jointType]);
console.log(JSON.stringify({ name: robot.robotName, links: Object.keys(robot.links), joints }));
