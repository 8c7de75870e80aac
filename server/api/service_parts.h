// The parts of the service that handlers use (server/api/handler.h).
#pragma once

namespace throng::jobs {
class Executor;
class TaskMeters;
}  // namespace throng::jobs

namespace throng::server {

class AnswerBudget;
struct Caller;
class Calibrations;
class ConfinedChecks;
class Datasets;
class Drain;
class Housekeeping;
class HttpMeters;
class JobQueue;
class Keys;
class LiveFlights;
class ReportMaker;
class RevokedKeys;
class ServiceFolders;
class Sessions;
class Studies;
class Uploads;
class WebhookSender;

}  // namespace throng::server
