// What visitors do with a site, in Chromium with a software renderer; see script/site_in_browser.
import {execFileSync} from 'node:child_process';
import fs from 'node:fs';
import http from 'node:http';
import {createRequire} from 'node:module';
import os from 'node:os';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

const [modules, parvis, ...rest] = process.argv.slice(2);
const option = name => rest.includes(name) ? rest.splice(rest.indexOf(name), 2)[1] : null;
const json = option('--json'), pictures = option('--pictures'), [scene] = rest;
const {chromium} = createRequire(path.join(modules, 'any.js'))('playwright-core');
const LIMIT_FLIP = 0.1;  // between the page and parvis render
const temporary = fs.mkdtempSync(path.join(os.tmpdir(), 'parvis-site-'));
const ARGUMENTS = ['--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--ignore-gpu-blocklist'];
if (process.getuid() === 0) ARGUMENTS.push('--no-sandbox');

const launch = (more = []) => chromium.launch({executablePath: '/usr/bin/chromium', args: [...ARGUMENTS, ...more]});
const size = folder => fs.readdirSync(folder, {recursive: true}).reduce((sum, name) => sum + fs.statSync(path.join(folder, name)).size, 0);
const wait = ms => new Promise(resolve => setTimeout(resolve, ms));

let failures = 0;
function expect(is, what) {
  console.log(`${is ? 'ok' : 'FAILED'}: ${what}`);
  if (!is) ++failures;
}

// A page whose errors fail the run.
async function open(browser, url, settings = {}) {
  const context = await browser.newContext({viewport: {width: 1280, height: 720}, ...settings});
  const page = await context.newPage();
  page.setDefaultTimeout(120000);  // other work may hold the processor
  page.on('pageerror', problem => expect(false, `no error of the page: ${problem.message}`));
  page.on('console', message => { if (message.type() === 'error') expect(false, `no error of the page: ${message.text()}`); });
  page.on('request', request => { if (!/^(file|data|blob|http:\/\/127\.0\.0\.1)/.test(request.url())) expect(false, `nothing is asked of the network: ${request.url()}`); });
  if (settings.throttle) await (await context.newCDPSession(page)).send('Emulation.setCPUThrottlingRate', {rate: settings.throttle});
  await page.goto(url);
  return page;
}
const ready = page => page.waitForFunction(() => window.parvis_app?.isComplete, null, {timeout: 180000});
// All that was asked for is drawn.
const settled = async page => {
  await page.waitForFunction(() => !parvis_app.isDirty && !parvis_app.traveller.flight, null, {timeout: 120000});
  await page.evaluate(() => new Promise(resolve => requestAnimationFrame(() => requestAnimationFrame(resolve))));
};
async function picture(page, file) {
  const style = await page.addStyleTag({content: '.card, #wipe, #lines, #progress { visibility: hidden !important }'});
  await page.screenshot({path: file});
  await style.evaluate(element => element.remove());
}
const eye = page => page.evaluate(() => parvis_app.camera.position.toArray());
const pixels = async page => (await page.screenshot()).toString('base64');

function flip(a, b) {
  const text = execFileSync(parvis, ['compare', a, b], {encoding: 'utf8'});
  return Number(/FLIP\s+([\d.]+)/i.exec(text)[1]);
}

// FLIP of each view in each scenario against parvis render, and a control: the sun three hours later.
async function compared(page, folder) {
  const {views, states} = await page.evaluate(() => ({views: parvis_app.site.views.map(({name}) => name), states: parvis_app.site.states.map(({name}) => name)}));
  const found = [];
  for (const [v, view] of views.entries())
    for (const [s, state] of states.entries()) {
      await page.evaluate(([v, s]) => { parvis_app.choose(s), parvis_app.traveller.goTo(parvis_app.view(v), true); }, [v, s]);
      await settled(page);
      const stem = path.join(folder, `${view}_${state}`.replace(/[^\w-]/g, '_'));
      await picture(page, `${stem}_page.png`);
      const camera = view === 'overview' ? [] : ['--camera', view];
      execFileSync(parvis, ['render', scene, ...camera, '--scenario', state, '-o', `${stem}_render.png`], {stdio: 'ignore'});
      found.push({view, state, flip: flip(`${stem}_page.png`, `${stem}_render.png`)});
      console.log(`  ${view}, ${state}: FLIP ${found.at(-1).flip.toFixed(3)}`);
    }
  const days = await page.evaluate(() => parvis_app.site.days.length);
  let control = null;
  if (days > 0) {
    await page.evaluate(() => { parvis_app.choose(0), parvis_app.traveller.goTo(parvis_app.view(0), true), parvis_app.setMoment(0, parvis_app.site.place.hour + 3); });
    await settled(page);
    const file = path.join(folder, 'control_page.png');
    await picture(page, file);
    control = flip(file, path.join(folder, `${views[0]}_${states[0]}`.replace(/[^\w-]/g, '_') + '_render.png'));
    await page.evaluate(() => { parvis_app.hour = null, parvis_app.choose(0); });
  }
  return {found, control};
}

async function asVisitor(page) {
  await settled(page);
  const states = await page.locator('#scenarios button').count();
  const before = await pixels(page);
  if (states > 1) {
    await page.locator('#scenarios button').nth(1).click();
    await settled(page);
    expect(await pixels(page) !== before, 'another scenario gives another picture');
    await page.getByRole('button', {name: 'Compare'}).click();
    await settled(page);
    const both = await pixels(page);
    const box = await page.locator('#wipe').boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2), await page.mouse.down();
    await page.mouse.move(300, 360, {steps: 3}), await page.mouse.up();
    await settled(page);
    expect(await pixels(page) !== both, 'the slider between two scenarios moves');
    await page.getByRole('button', {name: 'Compare'}).click();
    if (await page.getByRole('button', {name: 'Differences'}).count() > 0) {
      await page.getByRole('button', {name: 'Differences'}).click();
      expect(await page.locator('#side tr').count() > 0, 'the differences of two scenarios stand in a table');
      await page.getByRole('button', {name: 'Differences'}).click();
    }
    await page.locator('#scenarios button').nth(0).click();
  }
  if (await page.getByRole('button', {name: 'Measures'}).count() > 0) {
    await page.getByRole('button', {name: 'Measures'}).click();
    await settled(page);
    expect(await page.locator('#lines text').count() > 0, 'measures are shown with their values');
    await page.getByRole('button', {name: 'Measures'}).click();
  }
  if (await page.locator('#day').isVisible()) {
    await settled(page);
    const noon = await pixels(page);
    await page.locator('#hour').fill('9');
    await settled(page);
    expect(await pixels(page) !== noon, 'another hour gives another light');
  }
}

async function byKeys(page) {
  await page.locator('#picture').focus();
  const before = await eye(page);
  await page.keyboard.down('ArrowUp'), await wait(600), await page.keyboard.up('ArrowUp');
  await settled(page);
  expect(String(await eye(page)) !== String(before), 'the arrow keys move the eye');
  await page.keyboard.press('g');
  await settled(page);
  const standing = await eye(page);
  await page.keyboard.down('w'), await wait(900), await page.keyboard.up('w');
  await settled(page);
  const walked = await eye(page);
  expect(Math.hypot(walked[0] - standing[0], walked[1] - standing[1]) > 0.1, 'walking by keys moves');
  const ground = await page.evaluate(() => parvis_app.traveller.groundBelow(parvis_app.camera.position, parvis_app.camera.position.z));
  expect(Math.abs(walked[2] - ground - 1.7) < 0.01, `the walker's eye is 1.70 m above the ground (${(walked[2] - ground).toFixed(2)})`);
  await page.keyboard.press('1');
  await settled(page);
  const first = await page.evaluate(() => parvis_app.site.views[0].position);
  expect(Math.hypot(...(await eye(page)).map((x, i) => x - first[i])) < 0.01, 'a digit flies to a saved view');
  await page.keyboard.press('Tab');
  expect(await page.evaluate(() => document.activeElement.tagName) === 'BUTTON', 'buttons are reached by the keyboard');
}

async function byFingers(browser, url) {
  const page = await open(browser, url, {viewport: {width: 320, height: 640}, hasTouch: true, isMobile: true});
  await ready(page), await settled(page);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  expect(wide <= 320, `the page fits into 320 pixels (${wide})`);
  const outside = await page.evaluate(() => [...document.querySelectorAll('button, select, input')].filter(each => {
    const box = each.getBoundingClientRect();
    return box.width > 0 && !each.closest('.chips') && (box.left < -0.5 || box.right > 320.5);
  }).length);
  expect(outside === 0, 'no control lies beside a narrow window');
  const before = await eye(page), session = await page.context().newCDPSession(page);
  const touch = (type, ...points) => session.send('Input.dispatchTouchEvent', {type, touchPoints: points.map(([x, y], id) => ({x, y, id}))});
  await touch('touchStart', [160, 250]), await touch('touchMove', [200, 250]), await touch('touchMove', [240, 260]), await touch('touchEnd');
  await settled(page);
  const turned = await eye(page);
  expect(String(turned) !== String(before), 'a finger circles round the place');
  await touch('touchStart', [140, 250], [180, 250]), await touch('touchMove', [120, 250], [200, 250]), await touch('touchMove', [90, 250], [230, 250]), await touch('touchEnd');
  await settled(page);
  expect(String(await eye(page)) !== String(turned), 'two fingers come nearer');
  await page.locator('#menu').tap();
  expect(await page.locator('#tools').isVisible(), 'the menu opens by a tap');
  await page.getByRole('button', {name: 'Walk'}).tap();
  await page.locator('#menu').tap();
  await settled(page);
  const standing = await eye(page), pad = await page.locator('#pad').boundingBox();
  const [x, y] = [pad.x + pad.width / 2, pad.y + pad.height / 2];
  await touch('touchStart', [x, y]), await touch('touchMove', [x + 20, y - 50]), await wait(900), await touch('touchEnd');
  await settled(page);
  expect(String(await eye(page)) !== String(standing), 'the pad walks');
  if (pictures) await page.screenshot({path: path.join(pictures, 'narrow.png')});
  await page.context().close();
}

async function lostAndBack(page) {
  await page.evaluate(() => { parvis_app.choose(0), parvis_app.traveller.goTo(parvis_app.view(0), true); });
  await settled(page);
  const before = path.join(temporary, 'before.png'), after = path.join(temporary, 'after.png');
  await picture(page, before);
  await page.evaluate(() => { window.lose = parvis_app.renderer.getContext().getExtension('WEBGL_lose_context'), lose.loseContext(); });
  await page.waitForFunction(() => parvis_app.isLost);
  expect(await page.locator('#message').isVisible(), 'a lost context is said');
  await page.evaluate(() => lose.restoreContext());
  await page.waitForFunction(() => !parvis_app.isLost);
  await settled(page), await wait(500);
  await picture(page, after);
  const error = flip(after, before);
  expect(error < 0.01, `a restored context shows the same picture (FLIP ${error.toFixed(4)})`);
}

async function withoutWebgl(url) {
  const browser = await launch(['--disable-3d-apis']);
  const page = await open(browser, url);
  await page.waitForFunction(() => document.getElementById('still').complete && document.getElementById('still').naturalWidth > 0);
  expect(/WebGL 2/.test(await page.locator('#message').textContent()), 'without WebGL 2 the page says so');
  const first = await page.locator('#still').getAttribute('src');
  if (await page.locator('#scenarios button').count() > 1) {
    await page.locator('#scenarios button').nth(1).click();
    expect(await page.locator('#still').getAttribute('src') !== first, 'and shows still pictures of the scenarios');
  }
  if (pictures) await page.screenshot({path: path.join(pictures, 'without_webgl.png')});
  await browser.close();
}

// From a server: the folder as any server hands it out.
async function fromServer(browser, folder) {
  const server = http.createServer((request, reply) => {
    const file = path.join(folder, decodeURIComponent(new URL(request.url, 'http://127.0.0.1').pathname).replace(/\/$/, '/index.html'));
    if (!fs.existsSync(file)) return reply.writeHead(404).end();
    reply.writeHead(200, {'Content-Type': {'.html': 'text/html', '.js': 'text/javascript', '.jpg': 'image/jpeg'}[path.extname(file)] ?? 'application/octet-stream'});
    fs.createReadStream(file).pipe(reply);
  });
  await new Promise(resolve => server.listen(0, '127.0.0.1', resolve));
  const page = await open(browser, `http://127.0.0.1:${server.address().port}/`);
  await ready(page);
  expect(true, 'the site opens from a server');
  await page.context().close();
  server.close();
}

const site = path.join(temporary, 'site');
try {
  execFileSync(parvis, ['share', scene, '-o', site], {stdio: ['ignore', 'inherit', 'ignore']});
  if (pictures) fs.mkdirSync(pictures, {recursive: true});
  const url = pathToFileURL(path.join(site, 'index.html')).href;
  let browser = await launch();
  const firstPicture = async settings => {
    const page = await open(browser, url, settings);
    await page.waitForFunction(() => performance.getEntriesByName('first picture').length > 0, null, {timeout: 300000});
    const seconds = await page.evaluate(() => performance.getEntriesByName('first picture')[0].startTime / 1000);
    return [page, seconds];
  };
  const [page, first] = await firstPicture({});
  await ready(page);
  expect(true, 'the site opens by a double click');
  const {found, control} = await compared(page, pictures ?? temporary);
  const worst = Math.max(...found.map(each => each.flip));
  expect(worst <= LIMIT_FLIP, `every view looks as parvis render draws it: FLIP at most ${worst.toFixed(3)}`);
  if (control !== null) expect(control > LIMIT_FLIP, `three hours later it does not: FLIP ${control.toFixed(3)}`);
  await asVisitor(page), await byKeys(page), await lostAndBack(page);
  await byFingers(browser, url), await fromServer(browser, site), await withoutWebgl(url);
  if (json) {
    const times = [first], slow = [];
    for (let i = 0; i < 4; ++i) { const [again, seconds] = await firstPicture({}); times.push(seconds), await again.context().close(); }
    const [again, seconds] = await firstPicture({throttle: 20});
    slow.push(seconds), await again.context().close();
    times.sort((a, b) => a - b);
    fs.writeFileSync(json, JSON.stringify({mb: size(site) / 1e6, first_picture_s: times[2], first_picture_s_throttled: slow[0], flips: found, flip_control: control, failures}));
  }
  await browser.close();
} finally {
  fs.rmSync(temporary, {recursive: true, force: true});
}
process.exitCode = failures === 0 ? 0 : 1;
