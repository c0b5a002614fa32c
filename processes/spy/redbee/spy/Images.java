package redbee.spy;

import java.awt.image.BufferedImage;
import java.awt.image.DataBufferByte;
import java.io.ByteArrayInputStream;
import java.io.IOException;
import javax.imageio.ImageIO;
import redbee.foreground_t;
import redbee.image_t;

/** The image of a message: CAMERA and OVERLAY (image_t), FOREGROUND (foreground_t: P_FG). */
final class Images {
  private static final int GREY = 1497715271; // fourcc numbers, as bot_core's image_t has them
  private static final int RGB = 859981650;
  private static final int BGR = 861030210;
  private static final int MJPEG = 1196444237;

  private Images() {}

  static boolean isImage(long fingerprint) {
    return fingerprint == image_t.LCM_FINGERPRINT || fingerprint == foreground_t.LCM_FINGERPRINT;
  }

  /** Null where the message has none that can be shown. */
  static BufferedImage of(Object message) {
    try {
      if (message instanceof foreground_t) return compressed(((foreground_t) message).probability);
      if (message instanceof image_t) return ofImage((image_t) message);
    } catch (IOException | RuntimeException damaged) {
      // Whatever came over the network must not end the spy.
    }
    return null;
  }

  static String captionOf(Object message) {
    if (message instanceof foreground_t) {
      foreground_t m = (foreground_t) message;
      String[] states = {"good", "learning", "no homography", "bad image"};
      String state = m.status >= 0 && m.status < states.length ? states[m.status] : "?";
      return String.format("P_FG %dx%d  %s  utime %d", m.width, m.height, state, m.utime);
    }
    if (message instanceof image_t) {
      image_t m = (image_t) message;
      return String.format("%dx%d  utime %d", m.width, m.height, m.utime);
    }
    return "no image";
  }

  private static BufferedImage ofImage(image_t m) throws IOException {
    if (m.pixelformat == MJPEG) return compressed(m.data);
    int type = m.pixelformat == GREY ? BufferedImage.TYPE_BYTE_GRAY : BufferedImage.TYPE_3BYTE_BGR;
    if (m.pixelformat != GREY && m.pixelformat != RGB && m.pixelformat != BGR) return null;
    BufferedImage image = new BufferedImage(m.width, m.height, type);
    byte[] pixels = ((DataBufferByte) image.getRaster().getDataBuffer()).getData();
    int rowBytes = m.width * (m.pixelformat == GREY ? 1 : 3);
    for (int y = 0; y < m.height; ++y) System.arraycopy(m.data, y * m.row_stride, pixels, y * rowBytes, rowBytes);
    if (m.pixelformat == RGB) swapRedAndBlue(pixels);
    return image;
  }

  private static BufferedImage compressed(byte[] data) throws IOException {
    return ImageIO.read(new ByteArrayInputStream(data));
  }

  private static void swapRedAndBlue(byte[] pixels) {
    for (int i = 0; i + 2 < pixels.length; i += 3) {
      byte red = pixels[i];
      pixels[i] = pixels[i + 2];
      pixels[i + 2] = red;
    }
  }
}
