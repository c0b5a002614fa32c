// Seeds of imu_table_fuzz: a few rows of each app.
#pragma once

#include <map>
#include <string>

namespace redbee::fuzz {

inline std::map<std::string, std::string> imuTableSeeds() {
  const std::string cut = "\n%%\n";
  const std::string logger = "time,seconds_elapsed,z,y,x\n";
  return {{"sensor_logger",
           logger + "1600000000000000000,0.1,0.1,0.2,0.3\n1600000000010000000,0.11,0.1,0.2,0.3\n" + cut +
               logger + "1599999999990000000,0.1,0,9.8,0\n1600000000020000000,0.12,0,9.8,0\n" + cut +
               "platform,standardisation\nios,false\n"},
          {"mars",
           "Timestamp[nanosec],gx[rad/s],gy[rad/s],gz[rad/s],ax[m/s^2],ay[m/s^2],az[m/s^2]\n"
           "1000000000,0.1,0.2,0.3,0,9.8,0\n1010000000,0.1,0.2,0.3,0,9.8,0\n" +
               cut + cut + "1000000000\n"},
          {"open_camera", "0.1,0.2,0.3,1000000000\n0.1,0.2,0.3,1010000000\n" + cut +
                              "0,9.8,0,990000000\n0,9.8,0,1020000000\n" + cut + "1000000000\n"},
          {"gcsv",
           "GYROFLOW IMU LOG\nversion,1\norientation,YxZ\ntscale,0.001\ngscale,0.001\nascale,0.0005\n"
           "t,gx,gy,gz,ax,ay,az\n0,39,86,183,-1137,-1568,-2986\n1,56,100,202,-1179,-1569,-2887\n"}};
}

}  // namespace redbee::fuzz
