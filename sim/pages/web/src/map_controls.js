'use strict';
// Controls of a map: buttons, pointer and keys.

class MapControls {
  /** @param map  a MapView. */
  constructor(map) {
    this.map = map;
    this.addTools();
    this.addPointer();
    this.addKeys();
  }

  addTools() {
    const {map} = this;
    const tools = make('div', 'plan-tools');  // below the drawing, so that it covers no name
    map.canvas.after(tools);
    const button = (text, title, action) => {
      const b = tools.appendChild(make('button', '', text));
      b.title = title;
      b.addEventListener('click', action);
    };
    button('+', 'Zoom in', () => map.zoom(1.6));
    button('−', 'Zoom out', () => map.zoom(1 / 1.6));
    button('path', 'Show the flights', () => map.showReach());
    button('all', 'Show the whole scene', () => map.show({...map.whole}));
  }

  addPointer() {
    const {map} = this;
    let drag = null;
    map.canvas.addEventListener('pointerdown', (event) => {
      drag = {x: event.offsetX, y: event.offsetY, view: {...map.view}, moved: false};
    });
    map.canvas.addEventListener('pointermove', (event) => {
      if (drag && map.canvas.classList.contains('moves') && event.buttons) {
        const dx = event.offsetX - drag.x, dy = event.offsetY - drag.y;
        drag.moved ||= Math.hypot(dx, dy) > 4;
        map.show({...drag.view, n: drag.view.n + dy / map.scale, e: drag.view.e - dx / map.scale});
      } else {
        map.on.hover(event.offsetX, event.offsetY);
      }
    });
    map.canvas.addEventListener('pointerup', () => {
      if (drag && !drag.moved) map.on.click();
      drag = null;
    });
    map.canvas.addEventListener('pointerleave', () => {
      map.tip.hidden = true;
      map.on.leave();
    });
  }

  /** Arrow keys move the map by 10 %, + and - zoom, 0 shows the whole scene. */
  addKeys() {
    const {map} = this;
    const words = map.plan.goal ? `, goal at ${placeText(map.plan.goal.n, map.plan.goal.e)}` : '';
    describeDrawing(map.canvas, `Map of the scene and the flights, north up${words}. Arrow keys move it, plus and minus zoom, 0 shows the whole scene.`);
    map.canvas.tabIndex = 0;
    const moves = {ArrowUp: [0.1, 0], ArrowDown: [-0.1, 0], ArrowRight: [0, 0.1], ArrowLeft: [0, -0.1]};
    const zooms = {'+': 1.6, '=': 1.6, '-': 1 / 1.6};
    map.canvas.addEventListener('keydown', (event) => {
      const {n, e, width, height} = map.view, move = moves[event.key];
      if (move) map.show({n: n + move[0] * height, e: e + move[1] * width, width, height});
      else if (zooms[event.key]) map.zoom(zooms[event.key]);
      else if (event.key === '0') map.show({...map.whole});
      else return;
      event.preventDefault();
    });
  }
}
