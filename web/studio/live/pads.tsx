// Pads for fingers and pointers: left up, down and turn, in the middle the camera, right ahead and aside.
import type { TargetedPointerEvent } from "preact";
import { useState } from "preact/hooks";

interface PadProps {
  label: string;
  onMove: (right: number, up: number) => void; ///< -1 to 1
}

function Pad({ label, onMove }: PadProps) {
  const [offset, setOffset] = useState<[number, number] | null>(null);
  const move = (event: TargetedPointerEvent<HTMLDivElement>) => {
    if (!event.currentTarget.hasPointerCapture(event.pointerId)) return;
    const box = event.currentTarget.getBoundingClientRect();
    const limited = (value: number) => Math.max(-1, Math.min(1, value));
    const right = limited((2 * (event.clientX - box.left)) / box.width - 1);
    const up = limited(1 - (2 * (event.clientY - box.top)) / box.height);
    setOffset([right, up]);
    onMove(right, up);
  };
  const release = () => {
    setOffset(null);
    onMove(0, 0);
  };
  const [right, up] = offset ?? [0, 0];
  return (
    <div
      class="pad"
      role="application"
      aria-label={label}
      onPointerDown={(event) => {
        event.preventDefault();
        event.currentTarget.setPointerCapture(event.pointerId);
        move(event);
      }}
      onPointerMove={move}
      onPointerUp={release}
      onPointerCancel={release}
    >
      <span class="pad-knob" style={{ left: `${50 + 38 * right}%`, top: `${50 - 38 * up}%` }} />
    </div>
  );
}

interface PadsProps {
  onLeft: (right: number, up: number) => void;
  onRight: (right: number, up: number) => void;
  onCamera: (right: number, up: number) => void;
}

export function Pads({ onLeft, onRight, onCamera }: PadsProps) {
  return (
    <div class="pads">
      <Pad label="Up, down and turn" onMove={onLeft} />
      <Pad label="Camera: tilt and turn" onMove={onCamera} />
      <Pad label="Ahead, back and aside" onMove={onRight} />
    </div>
  );
}
