// Figures of a run that screens show (docs/metrics.md).

export interface Metrics {
  run: string;
  duration_s: number;
  alarm_s: number | null;
  people: number;
  people_counts?: {
    left_by_exit: { id: string; people: number }[];
    left_by_no_exit: number;
    inside: number;
    casualties: number;
    vanished_inside: number;
    turned_back: number;
    never_inside: number;
  };
  warnings?: string[];
  not_escaped: number;
  casualties: number;
  mean_escape_time_censored_s: number | null;
  escape_curve: { escaped_share: number[] }; ///< at 0, 1, 2, … s
  escape_time_percentiles: Record<string, number | null>;
  by_person?: { agent: number[]; hurt_s?: (number | null)[] };
  drones?: {
    id: string;
    falling_s: number | null;
    landed_s: number | null;
    battery_flat_s: number | null;
    collisions: Record<string, number>;
  }[];
  exits?: { id: string; time_in_state?: Record<string, number>; clogs?: { from_s: number; until_s: number; ended: boolean }[] }[];
  exposure: { max_density_2m2_per_m2: number | null } | null;
  exit_balance: { jain: number | null } | null; ///< null: nobody left
}
