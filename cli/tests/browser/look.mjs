// Opens reports in headless Chromium: `node look.mjs REPORT.html...`. Fails where the console has a message, a file is
// loaded, the page is wider than a window of 200 % zoom, the pointer reads nothing, or the print has not two pages.
import { resolve } from "node:path";
import { writeFileSync } from "node:fs";
import chromium from "@sparticuz/chromium";
import puppeteer from "puppeteer-core";

const args = [...chromium.args, "--no-sandbox"];
const browser = await puppeteer.launch({ args, executablePath: await chromium.executablePath(), headless: "shell" });
const faults = [];
for (const file of process.argv.slice(2)) {
  const fault = (text) => faults.push(`${file}: ${text}`);
  const page = await browser.newPage();
  page.on("console", (message) => fault(`console: ${message.text()}`));
  page.on("pageerror", (error) => fault(`error: ${error.message}`));
  page.on("request", (request) => {
    if (!/^(data:|blob:)/.test(request.url()) && !request.isNavigationRequest()) fault(`loads ${request.url()}`);
  });
  await page.setViewport({ width: 640, height: 450, deviceScaleFactor: 2 });
  await page.goto(`file://${resolve(file)}`);
  if (await page.evaluate(() => document.documentElement.scrollWidth > innerWidth)) fault("wider than the window");
  const centre = async (selector) => {
    const found = await page.$(selector);
    if (!found) return false;
    await found.scrollIntoView();
    const box = await found.boundingBox();
    await page.mouse.move(box.x + 0.4 * box.width, box.y + 0.4 * box.height);
    await new Promise((done) => setTimeout(done, 100));
    return true;
  };
  const texts = (selector) => page.$$eval(selector, (found) => found.map((one) => one.textContent).join(" "));
  if ((await centre(".u-over")) && !/\d/.test(await texts(".u-legend .u-value"))) fault("no value at the pointer of a chart");
  if ((await centre("canvas.map")) && !/\d/.test(await texts(".read"))) fault("no value at the pointer of a map");
  const slider = await page.$("input[type=range]");
  if (slider) {
    const before = await texts(".slider output");
    await slider.evaluate((one) => { one.value = 0; one.dispatchEvent(new Event("input")); });
    if (before === (await texts(".slider output"))) fault("the slider shows no other contact");
  }
  await page.screenshot({ path: file.replace(/html$/, "png"), fullPage: true });
  const pdf = Buffer.from(await page.pdf({ preferCSSPageSize: true, printBackground: true }));
  writeFileSync(file.replace(/html$/, "pdf"), pdf);
  const pages = pdf.toString("latin1").match(/\/Type\s*\/Page[^s]/g)?.length;
  if (pages !== 2) fault(`${pages} pages in print`);
  await page.close();
}
await browser.close();
faults.forEach((text) => console.error(text));
process.exit(faults.length === 0 ? 0 : 1);
