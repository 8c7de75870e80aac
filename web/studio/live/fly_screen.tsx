// Live flight: a drone is flown through the crowd; the service simulates and renders, this page steers and shows.
import { useAddress } from "../parts/router";
import { FlightBar, FlightFigures, FlightHeading, FlightHelp, FlightNotices, FlightStage } from "./flight_parts";
import { Pads } from "./pads";
import { FlightResult } from "./result";
import { StartFlight } from "./start";
import { useFlight } from "./use_flight";
import { useViews } from "./use_views";

function Flight({ id }: { id: string }) {
  const views = useViews();
  const flight = useFlight(id, views.swap);
  if (flight.result) return <FlightResult result={flight.result} id={id} />;
  const { hello, controls } = flight;
  return (
    <div class="screen fly">
      <FlightHeading flight={flight} />
      <FlightNotices flight={flight} />
      {hello && (
        <>
          <FlightStage hello={hello} flight={flight} views={views} />
          <FlightBar hello={hello} pilot={flight.pilot} views={views} />
          <FlightFigures hello={hello} flight={flight} />
          <Pads
            onLeft={(right, up) => controls.current && Object.assign(controls.current.touch, { turn: -right, up })}
            onCamera={(right, up) => controls.current && Object.assign(controls.current.touch, { pan: -right, tilt: up })}
            onRight={(right, up) => controls.current && Object.assign(controls.current.touch, { left: -right, ahead: up })}
          />
          <FlightHelp />
        </>
      )}
    </div>
  );
}

export function FlyScreen() {
  const { query } = useAddress();
  const id = query.get("flight");
  return id && /^[a-z0-9]+$/.test(id) ? <Flight key={id} id={id} /> : <StartFlight />;
}
