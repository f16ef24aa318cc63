// node browser.mjs CHROMIUM
// Opens pages from their files in one headless Chromium without network. Each line of standard input is a visit,
// {page, steps, image: PICTURE.png, width, height}, the last three optional: it runs `steps` in the page (the body of an
// async function) and prints one line, {value, errors: [...], requests: [...], opened_ms} or {failed}. `requests` has
// whatever the page asked for besides itself; opened_ms is from the call to the first frame drawn after the page's scripts.
import {spawn} from 'node:child_process';
import {mkdtempSync, rmSync, writeFileSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';
import {createInterface} from 'node:readline';
import {pathToFileURL} from 'node:url';

const profile = mkdtempSync(join(tmpdir(), 'hedgehop-chromium-'));
const browser = spawn(process.argv[2], ['--headless', '--no-sandbox', '--disable-gpu', '--enable-unsafe-swiftshader',
  '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync',
  '--hide-scrollbars', `--user-data-dir=${profile}`, '--remote-debugging-pipe', 'about:blank'],
  {stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'], detached: true});  // a group of its own, to be ended as one

// Chromium speaks its DevTools protocol over two pipes, messages ended by a zero byte.
const waiting = new Map(), listeners = new Map();
let rest = '', last = 0;
browser.stdio[4].setEncoding('utf8').on('data', (text) => {
  const messages = (rest + text).split('\0');
  rest = messages.pop();
  for (const message of messages.map((m) => JSON.parse(m))) {
    if (!message.id) listeners.get(message.sessionId)?.(message);
    else if (message.error) waiting.get(message.id).reject(new Error(message.error.message));
    else waiting.get(message.id).resolve(message.result);
  }
});
function send(method, params = {}, sessionId = undefined) {
  const id = ++last;
  browser.stdio[3].write(JSON.stringify({id, method, params, sessionId}) + '\0');
  return new Promise((resolve, reject) => waiting.set(id, {resolve, reject}));
}

async function visit({page, steps, image, width = 1400, height = 1000}) {
  const {targetInfos} = await send('Target.getTargets');
  const {targetId} = targetInfos.find(({type}) => type === 'page');
  const {sessionId} = await send('Target.attachToTarget', {targetId, flatten: true});
  const ask = (method, params) => send(method, params, sessionId);
  const errors = [], requests = [], url = pathToFileURL(page).href;
  let loaded;
  const load = new Promise((resolve) => { loaded = resolve; });
  listeners.set(sessionId, ({method, params}) => {
    if (method === 'Runtime.exceptionThrown') errors.push(params.exceptionDetails.exception?.description || params.exceptionDetails.text);
    if (method === 'Runtime.consoleAPICalled' && ['error', 'warning', 'assert'].includes(params.type)) {
      errors.push(params.args.map((a) => a.value ?? a.description).join(' '));
    }
    if (method === 'Log.entryAdded' && params.entry.level === 'error') errors.push(params.entry.text);
    if (method === 'Network.requestWillBeSent' && params.request.url.split('#')[0] !== url && !/^(data|blob):/.test(params.request.url)) {
      requests.push(params.request.url);
    }
    if (method === 'Page.loadEventFired') loaded();
  });
  for (const domain of ['Runtime', 'Log', 'Network', 'Page']) await ask(domain + '.enable');
  await ask('Network.emulateNetworkConditions', {offline: true, latency: 0, downloadThroughput: -1, uploadThroughput: -1});
  await ask('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: 1, mobile: false});
  const run = async (body) => {
    const {result, exceptionDetails} = await ask('Runtime.evaluate', {
      expression: `(async () => {${body}})()`, awaitPromise: true, returnByValue: true, userGesture: true});
    if (exceptionDetails) errors.push(exceptionDetails.exception?.description || exceptionDetails.text);
    return result.value;
  };
  const frame = 'await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));';
  const began = performance.now();
  await ask('Page.navigate', {url});
  await load;
  await run(frame);
  const opened_ms = Math.round(performance.now() - began);
  const value = await run(steps);
  await run(frame);
  if (image) {
    const {data} = await ask('Page.captureScreenshot', {format: 'png'});
    writeFileSync(image, Buffer.from(data, 'base64'));
  }
  await send('Target.detachFromTarget', {sessionId});
  listeners.delete(sessionId);
  return {value: value ?? null, errors, requests, opened_ms};
}

const gone = new Promise((resolve) => browser.on('exit', resolve));
const end = () => { try { process.kill(-browser.pid, 'SIGKILL'); } catch { /* gone already */ } };
/// Chromium's helpers may write into the profile until they are gone.
async function removeProfile() {
  for (let tries = 50; tries > 0; --tries) {
    try { return rmSync(profile, {recursive: true, force: true}); } catch { await new Promise((later) => setTimeout(later, 100)); }
  }
}
for await (const line of createInterface({input: process.stdin})) {
  const late = setTimeout(end, 90_000);
  const ended = gone.then(() => { throw new Error('Chromium ended too early'); });
  const answer = await Promise.race([visit(JSON.parse(line)), ended]).catch((error) => ({failed: String(error)}));
  clearTimeout(late);
  console.log(JSON.stringify(answer));
}
end();
await gone;
await removeProfile();
