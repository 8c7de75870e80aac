// The views of a live flight: one is large, one is an inset, the others are hidden.
import { useState } from "preact/hooks";

export type View = "camera" | "scene" | "plan";
export const kViews: { id: View; label: string }[] = [
  { id: "camera", label: "Camera" },
  { id: "scene", label: "3-D" },
  { id: "plan", label: "Plan" },
];

export function useViews() {
  const [main, setMain] = useState<View>("camera");
  const [inset, setInset] = useState<View>("plan");
  return {
    main,
    isShown: (view: View) => view === main || view === inset,
    /** The class of a view's element. */
    classOf: (view: View) => (view === main ? "fly-main" : view === inset ? "fly-inset" : "hidden"),
    select: (view: View) => {
      if (view === inset) setInset(main);
      setMain(view);
    },
    swap: () => {
      setMain(inset);
      setInset(main);
    },
  };
}

export type Views = ReturnType<typeof useViews>;
