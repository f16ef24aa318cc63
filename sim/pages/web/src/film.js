'use strict';
// The film of a flight: controls below the images, and wide films in two rows.

const WIDE = 2.8, CAPTION_PX = 22;  // width per height; height of the caption that Hedgehop adds below the images

/** Returns the parts of a wide film: sources and targets [x, y, width, height] in px, and the size of the drawing. */
function filmRows(width, height) {
  const images = height - CAPTION_PX, count = Math.max(2, Math.round(width / images));
  const first = Math.round(width * Math.ceil(count / 2) / count);
  return {width: first, height: 2 * images + CAPTION_PX, parts: [[0, 0, first, images, 0, 0], [first, 0, width - first, images, 0, images],
    [0, images, first, CAPTION_PX, 0, 2 * images]]};
}

class FilmView {
  /** @param film  video element. The controls follow it. */
  constructor(film) {
    this.film = film;
    film.addEventListener('click', () => this.toggle());
    this.bar = make('div', 'film-bar');
    this.play = this.bar.appendChild(make('button', '', 'play'));
    this.time = this.bar.appendChild(make('input'));
    Object.assign(this.time, {type: 'range', min: 0, max: 1, step: 'any', value: 0, ariaLabel: 'time in the film'});
    this.clock = this.bar.appendChild(make('output', 'soft'));
    this.large = this.bar.appendChild(make('button', '', 'full screen'));
    film.after(this.bar);
    this.play.addEventListener('click', () => this.toggle());
    this.large.addEventListener('click', () => (this.canvas ?? film).requestFullscreen());
    this.time.addEventListener('input', () => { film.currentTime = Number(this.time.value); });
    film.addEventListener('loadedmetadata', () => this.open());
    for (const name of ['loadeddata', 'timeupdate', 'seeked', 'play', 'pause']) film.addEventListener(name, () => this.update());
    film.addEventListener('play', () => this.follow());
    if (film.readyState > 0) this.open();
  }
  toggle() {
    if (this.film.paused) this.film.play();
    else this.film.pause();
  }
  /** Shows a wide film on a canvas in two rows. */
  open() {
    const {film} = this;
    this.time.max = film.duration;
    this.aspect = film.videoWidth / film.videoHeight;
    if (!this.canvas && this.aspect > WIDE) {
      this.rows = filmRows(film.videoWidth, film.videoHeight);
      this.aspect = this.rows.width / this.rows.height;
      this.canvas = make('canvas', 'film-rows');
      Object.assign(this.canvas, {width: this.rows.width, height: this.rows.height});
      describeDrawing(this.canvas, 'camera images');
      this.canvas.addEventListener('click', () => this.toggle());
      film.after(this.canvas);
      film.hidden = true;
    }
    this.update();
    film.dispatchEvent(new Event('opened'));
  }
  update() {
    const {film} = this;
    this.play.textContent = film.paused ? 'play' : 'pause';
    this.time.value = film.currentTime;
    this.clock.textContent = `${fixed(film.currentTime, 1)} of ${fixed(film.duration || 0, 1)} s`;
    if (!this.canvas) return;
    const c = this.canvas.getContext('2d');
    for (const [x, y, width, height, toX, toY] of this.rows.parts) c.drawImage(film, x, y, width, height, toX, toY, width, height);
  }
  follow() {
    this.update();
    if (!this.film.paused) requestAnimationFrame(() => this.follow());
  }
}
