// SPDX-License-Identifier: BSD-3-Clause
import { WebGLRenderer, type Camera, type Scene } from 'three';

/** Where a view is drawn. */
export interface Screen {
  readonly element: HTMLCanvasElement;
  draw(scene: Scene, camera: Camera, width: number, height: number): void;
}

/** At most two device pixels a side: more cannot be seen and costs four times the work. */
export const pixelRatio = (): number => Math.min(2, window.devicePixelRatio || 1);

function renderer(): WebGLRenderer {
  const made = new WebGLRenderer({ antialias: true, alpha: true, powerPreference: 'high-performance' });
  made.setClearColor(0x000000, 0);
  return made;
}

/** \throw where the browser has no WebGL 2 */
export function ownScreen(): Screen {
  const gl = renderer();
  return {
    element: gl.domElement,
    draw(scene, camera, width, height) {
      gl.setPixelRatio(pixelRatio());
      const size = gl.domElement, ratio = pixelRatio();
      if (size.width !== Math.floor(width * ratio) || size.height !== Math.floor(height * ratio)) gl.setSize(width, height, false);
      gl.render(scene, camera);
    },
  };
}

/** Several views share one context, for browsers give few of them: each keeps a copy of its picture. */
export function sharedScreens(): () => Screen {
  const gl = renderer();
  return () => {
    const element = document.createElement('canvas');
    const picture = element.getContext('2d')!;
    return {
      element,
      draw(scene, camera, width, height) {
        gl.setPixelRatio(pixelRatio());
        gl.setSize(width, height, false);
        gl.render(scene, camera);
        element.width = gl.domElement.width;
        element.height = gl.domElement.height;
        picture.drawImage(gl.domElement, 0, 0);
      },
    };
  };
}
