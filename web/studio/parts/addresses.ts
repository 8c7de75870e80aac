// Links and images name addresses of the service (api/base.ts): the browser's addresses are made here for all elements.
import { options } from "preact";
import { browserAddress } from "../api/base";

export function addBaseToElements(): void {
  const before = options.vnode;
  options.vnode = (vnode) => {
    if (typeof vnode.type === "string") {
      const props = vnode.props as Record<string, unknown>;
      for (const name of ["href", "src"]) {
        const value = props[name];
        if (typeof value === "string") props[name] = browserAddress(value);
      }
    }
    before?.(vnode);
  };
}
