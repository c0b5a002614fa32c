// Chromium without a window, driven over its DevTools protocol by a pipe: no port, no package.
// https://chromedevtools.github.io/devtools-protocol
'use strict';
const {spawn} = require('child_process');
const fs = require('fs');
const os = require('os');
const path = require('path');

class Browser {
  static async start(program) {
    const browser = new Browser();
    browser.profile = fs.mkdtempSync(path.join(os.tmpdir(), 'redbee-browser-'));
    browser.process = spawn(program, ['--headless', '--no-sandbox', '--disable-gpu', '--hide-scrollbars', '--no-first-run',
      '--disable-background-networking', '--disable-dev-shm-usage', '--force-color-profile=srgb', '--remote-debugging-pipe',
      `--user-data-dir=${browser.profile}`, 'about:blank'], {detached: true, stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe']});
    browser.next = 1;
    browser.waiting = new Map();
    browser.errors = [];
    browser.held = [];  // addresses of requests that Page.hold() keeps back
    browser.read();
    return browser;
  }

  read() {
    let rest = Buffer.alloc(0);
    this.process.stdio[4].on('data', (data) => {
      rest = Buffer.concat([rest, data]);
      for (let end; (end = rest.indexOf(0)) >= 0; rest = rest.subarray(end + 1)) this.receive(JSON.parse(rest.subarray(0, end)));
    });
  }

  receive(message) {
    if (message.method === 'Runtime.exceptionThrown') this.errors.push(message.params.exceptionDetails.exception?.description);
    if (message.method === 'Log.entryAdded' && message.params.entry.source === 'security') this.errors.push(message.params.entry.text);
    if (message.method === 'Fetch.requestPaused') {
      this.held.push(message.params.request.url);
      if (this.refusal)
        this.send('Fetch.fulfillRequest', {requestId: message.params.requestId, responseCode: this.refusal}, message.sessionId).catch(() => {});
    }
    const waiting = this.waiting.get(message.id);
    if (!waiting) return;
    this.waiting.delete(message.id);
    if (message.error) waiting.reject(new Error(JSON.stringify(message.error)));
    else waiting.resolve(message.result);
  }

  send(method, params = {}, sessionId = undefined) {
    const id = this.next++;
    this.process.stdio[3].write(JSON.stringify({id, method, params, sessionId}) + '\0');
    return new Promise((resolve, reject) => {
      this.waiting.set(id, {resolve, reject});
      setTimeout(() => reject(new Error(`${method}: Chromium does not answer`)), 60000).unref();
    });
  }

  async open(address, width = 1280, height = 900, is_mobile = false) {
    const {targetId} = await this.send('Target.createTarget', {url: 'about:blank'});
    const {sessionId} = await this.send('Target.attachToTarget', {targetId, flatten: true});
    const page = new Page(this, sessionId);
    await page.send('Page.enable');
    await page.send('Page.bringToFront');
    await page.send('Runtime.enable');
    await page.send('Log.enable');
    await page.send('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: is_mobile ? 2 : 1, mobile: is_mobile});
    await page.send('Page.navigate', {url: address});
    await page.until('the page is there', 'document.readyState === "complete"');
    return page;
  }

  async close() {
    // With the processes that it has started, which write into the profile.
    process.kill(-this.process.pid, 'SIGKILL');
    await new Promise((resolve) => this.process.on('close', resolve));
    fs.rmSync(this.profile, {recursive: true, force: true, maxRetries: 20, retryDelay: 100});
  }
}

class Page {
  constructor(browser, session) { Object.assign(this, {browser, session}); }

  send(method, params) { return this.browser.send(method, params, this.session); }

  /** The value of an expression, promises awaited. */
  async value(expression) {
    const {result, exceptionDetails} = await this.send('Runtime.evaluate', {expression, awaitPromise: true, returnByValue: true});
    if (exceptionDetails) throw new Error(`${expression}: ${exceptionDetails.exception?.description ?? exceptionDetails.text}`);
    return result.value;
  }

  /** Waits as long as a loaded machine may take. */
  async until(what, expression, seconds = 60) {
    const end = Date.now() + 1000 * seconds;
    for (;;) {
      const value = await this.value(expression).catch(() => false);
      if (value) return value;
      if (Date.now() > end) throw new Error(`${what}: not after ${seconds} s (${expression})`);
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
  }

  /** Requests to these addresses are not answered, until release(). */
  hold(...addresses) { return this.send('Fetch.enable', {patterns: addresses.map((address) => ({urlPattern: `*${address}`}))}); }
  /** They are answered by this status instead, until release(). */
  refuse(status, ...addresses) {
    this.browser.held = [];
    this.browser.refusal = status;
    return this.hold(...addresses);
  }
  release() {
    this.browser.refusal = undefined;
    return this.send('Fetch.disable');
  }

  /** A key, by its name in KeyboardEvent.key. */
  async press(key, modifiers = 0) {
    const text = key.length === 1 ? key : undefined;
    await this.send('Input.dispatchKeyEvent', {type: 'keyDown', key, text, modifiers});
    await this.send('Input.dispatchKeyEvent', {type: 'keyUp', key, modifiers});
  }

  /** The whole page: as high a window as it takes, since Chromium may not answer where it shall look beyond its window. */
  async screenshot(file, width, is_mobile = false) {
    const height = await this.value('document.documentElement.scrollHeight');
    await this.send('Emulation.setDeviceMetricsOverride', {width, height, deviceScaleFactor: is_mobile ? 2 : 1, mobile: is_mobile});
    await this.value('new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))');
    const {data} = await this.send('Page.captureScreenshot', {format: 'png'});
    fs.writeFileSync(file, Buffer.from(data, 'base64'));
  }
}

module.exports = {Browser};
